"""Print a map's mesh in numbers, draw it, and search a path on it.

Exit codes
0: done. 1: no path. 2: a wrong argument, or a map that cannot be read.

Example
./navvi navmesh my_map.bt -o mesh.png --from 1,-9 --to 1,6
"""
import os
import re
import sys
import tempfile
from pathlib import Path

from navvi_cli.arguments import parameter
from navvi_cli.say import fail, say
from navvi_cli.workspace import tool
from navvi_cli.worlds import answer, picture, table

STAGES = ["map", "bake", "mesh", "search", "smooth"]


def map_file(word):
    if os.path.splitext(word)[1] not in (".bt", ".ot", ".yaml"):
        fail(f"\"{word}\" is not a map; files that end in .bt, .ot (OctoMap) and .yaml (map_server) are allowed.", 2)
    return word


def is_small(path):
    return os.path.isfile(path) and Path(path).stat().st_size < 64 << 20


def pixels(path, folder):
    """The picture of the map_server map `path` as a PGM of bytes in `folder`, where it is another: navmesh_tool reads no other."""
    named = re.search(r"^image: *[\"']?([^\"'#\n]+)", Path(path).read_text(errors="replace"), re.M) if is_small(path) and path.endswith(".yaml") else None
    images = [Path(path).parent / named[1].strip(), Path(path).parent / Path(named[1].strip()).name] if named else []
    image = next(filter(is_small, images), None)
    if image is None or image.read_bytes()[:2] == b"P5":
        return []  # the tool says what is wrong, if anything is
    try:
        import numpy
        from PIL import Image
        with Image.open(image) as picture:
            white = Image.new("RGBA", picture.size, "white")
            grey = numpy.asarray(Image.alpha_composite(white, picture.convert("RGBA")), dtype=int)[:, :, :3].sum(axis=2) // 3
    except ImportError:
        fail(f"{image}: reading a picture that is not a PGM (P5) takes the Debian package python3-pil; `sudo apt install python3-pil` installs it.", 2)
    except Exception as problem:  # Pillow raises many kinds
        fail(f"{image}: the picture cannot be read: {problem}.", 2)
    made = Path(folder) / "map.pgm"
    made.write_bytes(b"P5 %d %d 255\n" % grey.shape[::-1] + grey.astype("uint8").tobytes())
    return [f"picture:={made}"]


def numbers_in(count):
    """The argument type of numbers with commas between, as a list."""
    def read(word):
        try:
            values = [float(number) for number in word.split(",")]
        except ValueError:
            values = []
        if len(values) != count:
            fail(f"\"{word}\" is not {count} numbers with commas between, such as {'1.5,2' if count == 2 else '1.5,2,0.4'}.", 2)
        return values
    return read


def arguments(parser):
    parser.add_argument("map", metavar="MAP", type=map_file, help="an OctoMap (.bt, .ot) or a map_server map (.yaml).")
    parser.add_argument("--csv", action="store_true", help="the numbers as a table for a program.")
    parser.add_argument("-o", dest="picture", metavar="FILE", type=picture, help="draw the map, its mesh, the cylinders and the path, as .svg or .png.")
    parser.add_argument("--from", metavar="X,Y", type=numbers_in(2), help="where a path begins; m in map.")
    parser.add_argument("--to", metavar="X,Y", type=numbers_in(2), help="where it ends.")
    parser.add_argument("--cylinder", metavar="X,Y,R", type=numbers_in(3), action="append", default=[], help="cut a hole around something that moves; m in map.")
    parser.add_argument("--stage", metavar="STAGE", choices=STAGES,
                        help="stop after map, bake, mesh (holes), search (shortest path) or smooth (the default).")
    parser.add_argument("--config", metavar="FILE", help="a .yaml with parameters that differ from the defaults, as in nav_node's config files.")
    parser.add_argument("parameters", nargs="*", default=[], metavar="NAME:=VALUE", type=parameter, help="a single one, as in mesh/climb:=0.1")


def run(args):
    given = {name: getattr(args, name) for name in ("from", "to", "stage", "config") if getattr(args, name) is not None}
    given["cylinders"] = [number for at in args.cylinder for number in at]
    drawing = ["drawing:=true"] if args.picture else []
    program = tool("navvi_nav", "navmesh_tool")
    with tempfile.TemporaryDirectory() as folder:
        words = [*pixels(args.map, folder), *(f"{name}:={value}" for name, value in given.items()), *drawing, *args.parameters]
        done, found = answer(program, args.map, *words)
    sys.stderr.write(done.stderr)
    if not found:
        return done.returncode
    if args.picture:
        from navvi_cli import maps
        maps.save(maps.mesh(found, args.cylinder if given.get("stage") not in ("map", "bake") else []), args.picture)
    if args.csv:
        table(["what", "value"], ((name, value) for name, value in found.items() if name not in ("origin m", "ground", "mesh")))
    else:
        print("\n".join(f"{name:12}{text}" for name, text in sentences(found)), flush=True)
    if "refusal" in found:
        print(f"navmesh: {found['refusal']}.", file=sys.stderr)
    if args.picture:
        say(f"the picture is in {args.picture}.")
    return done.returncode


def sentences(found):
    """What is known of a mesh and a path, for a person."""
    if found["map"]:
        yield "map", found["map"]
    yield "floor", f"{found['floor length m']:.2f} x {found['floor width m']:.2f} m in cells of {found['cell m']:.3g} m, at z = {found['floor z m']:.2f} m"
    yield "mesh", (f"{found['mesh m^2']:.1f} m^2, {found['polygons']} polygons, {found['vertices']} vertices, {found['portals']} portals, "
                   f"{found['tiles']} tiles, {found['components']} components, the largest of {found['largest component m^2']:.1f} m^2")
    yield "memory", f"{found['memory bytes']} bytes, {found['memory bytes'] / max(found['mesh m^2'], 0.1):.1f} a square metre"
    yield "time", f"{found['survey ms']:.1f} ms to read and survey, {found['bake ms']:.1f} ms to bake, {found['cut ms']:.2f} ms to cut holes"
    if "path" in found:
        yield "query", f"{found['query ms']:.3f} ms with smoothing, {found['nodes']} nodes"
        yield "shortest", f"{found['shortest way m']:.6f} m"
        path, turns = (" ".join(f"{x:.2f},{y:.2f}" for x, y in found[name]) for name in ("path", "turns"))
        yield "guide path", f"{found['guide path m']:.3f} m: {path}"
        yield "turns", f"{len(found['turns'])}: {turns}"
