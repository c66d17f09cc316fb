"""The plan's worlds as the reference driver meets them: the simulated person without errors, in the loop without ROS."""
import csv
import io
import json
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .errors import StudyError

LIKE = 1.25  # times: the most of a set over the least, of ways, of turns and of the reference driver's times
FEW = 2  # turns that sets may be apart, however few they are


def drive(plan, trials_bench, jobs=2):
    """Rows of the bench by world, each driven once with all that guides. Raises StudyError for a world that cannot be."""
    worlds = plan.worlds

    def one(world):
        rows = [drive_leg(world, words) for words in plan.legs(world)]
        return rows[0] if len(rows) == 1 else _together(rows)

    def drive_leg(world, words):
        command = [str(trials_bench), f"--world={plan.world_file(world) or world.world}", f"--seeds={world.seed}", f"--limit={plan.limit:.0f}", "--csv", *words]
        result = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
        rows = list(csv.DictReader(io.StringIO(result.stdout)))
        if result.returncode != 0 or len(rows) != 1:
            raise StudyError(f"{plan.file}: no trial can be driven in {world}: {(result.stderr or result.stdout).strip()}")
        return rows[0]

    with ThreadPoolExecutor(jobs) as pool:
        return dict(zip(worlds, pool.map(one, worlds)))


def require_files(plan, tool):
    """Raises StudyError for zones and jobs that a session refuses, and for a world's file in which nothing stands; named ones are full."""
    def answer(*command):
        result = subprocess.run([*map(str, command)], capture_output=True, text=True, errors="replace", check=False)
        if result.returncode != 0:
            raise StudyError(f"{plan.file}: no trial can be driven in {command[-1]}: {result.stderr.strip().removeprefix('navvi: ')}")
        return result.stdout

    for zones in sorted({word for world in plan.worlds for word in plan.zones(world)}):
        answer(tool("navvi_study", "trials_bench"), "--check", zones)
    for job in sorted({beside["jobs"] for world in plan.worlds if "jobs" in (beside := plan.beside(world))}):
        answer(tool("navvi_feedback", "feedback_node"), "--parameters", f"places:={job}")
    for file in sorted({plan.world_file(world) for world in plan.worlds} - {None}):
        if not json.loads(answer(tool("navvi_sim", "world_tool"), "check", file))["standing"]:
            raise StudyError(f"{plan.file}: nothing stands in {file}, and a trial there measures nothing; allowed are worlds with things on their floor.")


def pictures(plan, draw):
    """Draws all worlds from above, with the path and its turns. Returns the files."""
    folder = plan.folder / "worlds"
    folder.mkdir(parents=True, exist_ok=True)
    files = {world: folder / f"{Path(world.world).stem}-{world.seed}.svg" for world in plan.worlds}
    for world, file in files.items():
        draw(str(plan.world_file(world) or world.world), _words(plan, world), file)
    return [*files.values()]


def picture_for(plan, draw):
    """A function of world and seed as they stand in the record and of driven ways: the picture as SVG, empty where it cannot be drawn."""
    def picture(world, seed, driven):
        known = [one for one in plan.worlds if str(one.seed) == seed and Path(one.world).stem == Path(world).stem]
        svg = io.BytesIO()
        try:
            for one in known[:1]:
                draw(str(plan.world_file(one) or one.world), _words(plan, one), svg, driven)
        except (StudyError, OSError):
            return b""
        return svg.getvalue()
    return picture


def _words(plan, world):
    return [f"seed:={world.seed}", *plan.zones(world)]


def _together(rows):
    """The legs of a job as one row."""
    row = {name: sum(float(one[name]) for one in rows) for name in ("shortest_path_m", "elapsed_s", "mover_proximity_count")}
    return {**row, "result": next((one["result"] for one in rows if one["result"] != "reached"), "reached"),
            "turns_per_min": 60 * sum(map(_turns, rows)) / row["elapsed_s"]}


def _turns(row):
    """Of a row of the bench, which has them a minute."""
    return float(row["turns_per_min"]) * float(row["elapsed_s"]) / 60


def compared(plan, driven):
    """Lines on the worlds, and whether the sets are alike."""
    lines, sets = ["The reference driver: way in m, turns that were told, how often a mover came within 5 m, time in s:"], {}
    for name, worlds in [*((f"set {at}", worlds) for at, worlds in enumerate(plan.sets, 1)), ("reserve", plan.reserve),
                         *plan.other_worlds.items()]:
        for world in worlds:
            row = driven[world]
            lines.append(f"  {name}: {world}: {row['result']}, way {float(row['shortest_path_m']):.1f}, turns {_turns(row):.0f}, movers {float(row['mover_proximity_count']):.0f}, time {float(row['elapsed_s']):.1f}.")
        if name.startswith("set"):
            rows = [driven[world] for world in worlds]
            sets[name] = {"ways": sum(float(row["shortest_path_m"]) for row in rows), "turns": sum(round(_turns(row)) for row in rows),
                          "times": sum(float(row["elapsed_s"]) for row in rows)}
            lines.append(f"  {name}: all together way {sets[name]['ways']:.1f}, turns {sets[name]['turns']}, "
                         f"movers {sum(float(row['mover_proximity_count']) for row in rows):.0f}, time {sets[name]['times']:.1f}.")
    alike = True
    for what in ("ways", "turns", "times"):
        ranked = sorted(sets, key=lambda name: sets[name][what])
        least, most = ranked[0], ranked[-1]
        low, high = sets[least][what], sets[most][what]
        good = high <= LIKE * low or (what == "turns" and high - low <= FEW)
        alike = alike and good
        lines.append(f"The {what} of {most} are {high:.4g}, those of {least} {low:.4g}; "
                     + ("alike enough." if good else f"other seeds would be better: alike are {LIKE} times" + (f", or {FEW} turns." if what == "turns" else ".")))
    late = [str(world) for world, row in driven.items() if row["result"] != "reached"]
    if late:
        lines.append(f"Within {plan.limit:g} s the reference driver does not arrive in: {', '.join(late)}; choose others.")
    return lines, alike and not late
