"""Whole sessions by hand and ear. Nothing is looked at: what is pressed depends on what is said, and the simulated operator drives by ear."""
from sessions import Programs

HALL = ("name: hall\npreset: easy\nlayout: {length: 11, width: 13, rows: 1, blocks: 1, bays: 1, docks: 1, aisle: 3.2, staged: 0, "
        "forklifts: 0, pallet_robots: 0, walking_workers: 0, standing_workers: 0}\n")


def session(env, folder, person, results, *words):
    """A session in a small hall, with a trial for each of `results`, words of its summary. Returns what the person heard and pressed."""
    layout = folder / "hall.yaml"
    layout.write_text(HALL)
    with Programs(env, folder / "log") as programs:
        programs.launch("live.launch", f"operator:={'auto' if person == 'auto' else 'keyboard'}", f"world:={layout}", "once:=false", "speech:=false",
                        "feedback_parameters:={listener: topic}", "sim_parameters:={scenario: {min_route: 4, max_route: 7}}", f"out:={folder}", "limit:=300", *words)
        told = programs.person("person.py", *person.split(","), seconds=600)
        print(told)
    assert "was ended by signal" not in (folder / "log").read_text()
    found = [path.read_text().splitlines()[1] for path in sorted(folder.glob("trial-*/summary.csv"))]
    assert len(found) == len(results) and all(word in row for row, word in zip(found, results)), found
    return told
