"""Run many simulated trials, each a row of a table.

Each world, seed, person and condition makes a trial. A batch that was killed
goes on when it is called again with the same words, version and files. At its
end DIR holds trials.csv, a row a trial, with the same bytes for every --jobs
and --shard, and trials.json, what each column means. doc/batch.md tells more.

A person is able, typical, struggling, deafblind, noise or drawn: in each world
another one, or those with your seeds, such as drawn:1-20. A condition is
default, sounds_off, touch_off, words_off, words_alone, flow, hand, hand_alone,
brief, sighted (the reference), or a name of your own:
slow=feedback/drive/max_forward:=0.5+nav/replan/period:=3

Exit codes
0: done. 1: some failed, are not done, or changed. 2: a wrong argument, or a
full disk.

Examples
./navvi batch --worlds=busy --seeds=1-20 --people=able,typical --out=busy
./navvi batch --people=drawn:1-20 --conditions=default,words_alone --out=drawn
"""

from navvi_cli import places
from navvi_cli.arguments import number
from navvi_cli.say import fail
from navvi_cli.worlds import check_name


def arguments(parser):
    parser.add_argument("--worlds", default="busy", metavar="NAME,...", help="names or files of worlds. Default: busy.")
    parser.add_argument("--seeds", default="1-10", metavar="1-10", help="of the worlds.")
    parser.add_argument("--people", default="typical", metavar="TYPE[:SEEDS],...", help="who drives. Default: typical.")
    parser.add_argument("--conditions", default="default", metavar="NAME,...", help="what is played. Default: default.")
    parser.add_argument("--limit", type=number("--limit", 1, 10**9), default=600, metavar="S", help="s of a trial. Default: 600.")
    parser.add_argument("--jobs", type=number("--jobs", 1, 256), default=1, metavar="N", help="trials at a time. Default: 1.")
    parser.add_argument("--cache", type=number("--cache", 0, 10**6), default=512, metavar="MB",
                        help="of worlds that are kept for other trials. Default: 512.")
    parser.add_argument("--records", default="failed", choices=("all", "failed", "none"),
                        help="journal, track and bag of which trials are kept in DIR/records; failed: those that do not reach the goal, the default.")
    parser.add_argument("--shard", default="1/1", metavar="K/N", help="the part of the trials to run.")
    parser.add_argument("--tell", type=number("--tell", 0, 86400, float), default=10.0, metavar="S",
                        help="s between two lines of progress. Default: 10.")
    parser.add_argument("--out", required=True, metavar="DIR", help="folder of the tables.")


def run(args):
    from navvi_cli.version import version
    from navvi_cli.workspace import enter, tool
    from navvi_people import batch
    from navvi_study.table import figures
    for world in args.worlds.split(","):
        check_name(world)
    try:
        batch.trials_of(args), batch.shard_of(args.shard)  # before anything is built
        program, counter = (tool("navvi_study", name) for name in ("trials_bench", "count_trial"))
        enter()
        return batch.run_batch(program, figures(counter), args, version())
    except batch.BatchError as problem:
        fail(str(problem), problem.code)
