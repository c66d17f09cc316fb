"""The actions of `./navvi study`: each a function with its help and its arguments. Nothing here knows how programs are built."""
import difflib
from pathlib import Path

from .errors import StudyError

# Set by the command: tool(PACKAGE, PROGRAM) builds a program and returns its path; accept(PARAMETERS) raises StudyError for those that a
# session refuses; navvi and version are of the product.
TOOLS = {}
ACTIONS = {}  # by name


def action(*given):
    """Makes a function an action of ./navvi study, as parser.add_actions takes it; its docstring is the help. \\param given  its arguments"""
    def made(run):
        run.run, run.arguments = run, lambda parser: [parser.add_argument(*words, **more) for words, more in given]
        ACTIONS[run.__name__.rstrip("_")] = run
        return run
    return made


def argument(*words, **more):
    return words, more


PLAN = argument("plan", metavar="PLAN", help="the study's YAML file; all that is recorded is kept in the folder beside it that bears the study's name.")
PARTICIPANT = argument("participant", metavar="PARTICIPANT", help="a code of the plan, such as sub-03.")
ONLY = argument("--only", metavar="MEASURE", help="only the tables, and the figure of one measure, such as time, as SVG.")


def opened(args):
    """The study. Raises StudyError where its journal has lost rows."""
    study = _opened(args)
    if lost := study.unrecorded():
        raise StudyError("\n  ".join([*lost.values(), f"Where there is no copy: ./navvi study verify {args.plan} --accept-loss TEXT"]))
    return study


def _opened(args):
    from .study import Study
    return Study.of(args.plan)


@action(PLAN, argument("--no-worlds", action="store_true", help="leave worlds and parameters unchecked; each world takes some seconds."),
        argument("--pictures", action="store_true", help="draw each world from above, as SVG in the folder worlds of the study."))
def check(args):
    """Print the whole schedule of a study before anything starts.

    The file is read strictly; then follow conditions, the order of each
    participant, the minutes of each session, and each world as the reference
    driver meets it.

    Exit codes
    0: the plan can be run. 1: it can, and other worlds are recommended: sets are
    not alike, or the reference driver does not arrive. 2: it cannot, and why.
    """
    from . import overview, plan_file, worlds
    planned = plan_file.load(args.plan)
    print("\n".join(overview.schedule(planned)))
    if args.no_worlds:
        print("\nThe worlds and the parameters of the conditions were not checked.")
        return 0
    _require_runnable(planned)
    lines, alike = worlds.compared(planned, worlds.drive(planned, TOOLS["tool"]("navvi_study", "trials_bench")))
    print("\n".join(["", *lines]))
    for picture in worlds.pictures(planned, TOOLS["draw"]) if args.pictures else []:
        print(f"navvi: written: {picture}")
    return 0 if alike else 1


@action(PLAN, argument("--reason", metavar="TEXT", help="why a plan that was frozen has changed."))
def freeze(args):
    """Fix the plan: its hash, the version of NavVI, outcome and exclusions.

    Nothing is recorded before. A plan that changes later must be frozen again
    with a reason; the report lists each change. preregistration.md has the plan
    in words, for a registry.

    Exit codes
    0: frozen. 2: a wrong plan, or nothing to freeze.
    """
    from . import overview, preregistration
    study = opened(args)
    _require_runnable(study.plan)
    if study.frozen() is not None:  # its page is missing where the disk was full after the freeze
        preregistration.write(study)
    changes = study.freeze(TOOLS["version"](), args.reason)
    print(f"navvi: the plan is frozen: {study.plan.hash()}")
    for change in changes or []:
        print(f"  changed: {change}")
    print("\n".join([*overview.broken_off(study.plan), *overview.judged_otherwise(study, study.progress())]))
    print(f"navvi: written: {preregistration.write(study)}")


@action(PLAN, PARTICIPANT, argument("--typed", action="store_true", help="questionnaires are read aloud by the experimenter and answered in this terminal."),
        argument("--session", action="store_true", help="go on to the end of the session, without a wait for the next command."))
def next_(args):
    """Start the next thing that a participant does.

    Consent, calibration, practice, a trial, a questionnaire or a break: what comes
    next by plan and record. After a crash, a break or a trial that does not count
    it goes on from there. While a trial runs, lines typed here are recorded: m for
    a mark, n TEXT for a note, i TEXT for an intervention, p to pause after this
    step, a to end the trial.

    Exit codes
    0: done. 1: broken off. 2: not allowed, and why. 3: nothing is left to do.
    """
    study = opened(args)
    study.progress().person(args.participant)
    study.require_frozen()
    session = _live_session(study, args.typed)
    while True:
        finished = _finished(study, args.participant)
        step = session.next(args.participant)
        if finished:
            return 3
        if step is None:
            return 1
        if not args.session or step.kind == "session_end":
            return 0
        session.runner.pause()


@action(PLAN, PARTICIPANT)
def stop(args):
    """End what is running of a participant, as Ctrl-C would.

    For a session that goes on after its "study next" was killed. Its trial is kept
    as broken off, and the next "study next" goes on with a world of the reserve.

    Exit codes
    0: ended, or nothing was running. 2: not planned, or it does not end.
    """
    study = _opened(args)
    ended = study.stop(study.progress().person(args.participant).name)
    print("navvi: ended: " + ", ".join(f"{pid} ({name})" for pid, name in ended.items()) + "." if ended else f"navvi: nothing of {args.participant} is running.")


@action(PLAN, ONLY)
def run(args):
    """Lead all simulated participants through the plan, live, to the report.

    For a plan whose operator is simulated: sessions as with people, with all nodes,
    in real time. What broke off goes on when it is called again.

    Exit codes
    0: done, and the report is written. 1: broken off. 2: not allowed, and why.
    """
    study = opened(args)
    study.require_frozen()
    if study.plan.operator != "simulated":
        raise StudyError(f"the operator of the plan is \"{study.plan.operator}\"; study run is for simulated, and \"study next\" leads a person.")
    session = _live_session(study, typed=False)
    for name in study.plan.participants:
        while not _finished(study, name):
            if session.next(name) is None:
                return 1
    _write_report(study.blinded() if study.concealed else study, args.only, rehearsed=False)
    return 0


@action(PLAN)
def status(args):
    """Print how far each participant is, and what comes next.

    Exit codes
    0: printed. 2: a wrong plan, or a damaged record.
    """
    from . import overview
    study = _opened(args)
    print("\n".join([*overview.status(study, study.progress()), *study.unrecorded().values()]))


@action(PLAN, argument("what", metavar="TRIAL", help="a trial by its name, such as sub-03/trial-20260101T120000Z, or the code of a participant."),
        argument("--reason", metavar="TEXT", required=True, help="why, in words."),
        argument("--no-replacement", action="store_true", help="no other trial takes its place."))
def exclude(args):
    """Write that a trial, or a participant, does not count.

    Nothing is deleted: a row is appended that names who, when and why, and holds
    the hash of the row before it. A world of the reserve takes the trial's place.

    Exit codes
    0: written. 2: no such trial, or excluded before.
    """
    reason = _reason(args.reason)
    study = opened(args)
    progress = study.progress()
    if args.what in progress.people:
        if progress.people[args.what].excluded:
            raise StudyError(f"{args.what} is excluded already: {progress.people[args.what].excluded}.")
        study.journal.append("exclude", participant=args.what, reason=reason, rule=False)
        print(f"navvi: {args.what} does not count: {reason}.")
        return
    person, attempt = progress.find(args.what)
    if attempt.excluded and not attempt.dropped_out:
        raise StudyError(f"{args.what} is excluded already: {attempt.excluded}.")
    study.journal.append("exclude", participant=person.name, step=attempt.step, attempt=attempt.number, trial=attempt.trial, reason=reason,
                         rule=False, replace=not args.no_replacement)
    state = study.progress()
    person, step = state.person(person.name), person.step(attempt.step)
    # Also of practice and probes; a plan that was frozen anew may have no such step.
    over = args.no_replacement or not step or state.next(person) is None or step.finished(state, person) or step.given_up(state, person)
    print(f"navvi: {person.name}/{attempt.trial} does not count: {reason}." + ("" if over else " Another world takes its place."))


@action(PLAN, PARTICIPANT, argument("--data", metavar="delete|keep", required=True, choices=("delete", "keep"), help="what was recorded."))
def withdraw(args):
    """Write that a participant has withdrawn, and delete or keep what there is.

    Deleted are trials, answers, notes and settings, and the study's tables, figures,
    reports and export, which hold them too; the journal keeps, by the code, times,
    conditions, results, collisions, consent, practice mastered and reasons of exclusions.

    Exit codes
    0: written. 2: not planned, or withdrawn before.
    """
    study = (_opened if args.data == "delete" else opened)(args)
    person = study.progress().person(args.participant)
    if person.withdrawn == "delete" or person.withdrawn == args.data:
        raise StudyError(f"{person.name} has withdrawn already.")
    with study.claimed(person.name):
        study.journal.append("withdraw", participant=person.name, data=args.data)
    study.finish_erasing()
    deleted = "deleted, with tables, figures, reports and export of the study; \"study report\" and \"study export\" write those anew, of the others"
    print(f"navvi: {person.name} has withdrawn; what was recorded is {deleted if args.data == 'delete' else 'kept'}.")
    if study.unrecorded():
        print("navvi: the journal has lost rows; withdraw again once it is restored from a copy.")


@action(PLAN)
def table(args):
    """Write trials.csv and answers.csv, with a JSON file that describes each column.

    Exit codes
    0: written. 2: a wrong plan, or a damaged record.
    """
    from . import table
    study = opened(args)
    study.require_analysis()
    _written(study, *table.write(study, study.progress(), _figures()))


@action(PLAN, argument("--accept-loss", metavar="TEXT", help="why the study goes on without the rows that its journal has lost."))
def verify(args):
    """Count each trial's summary again, from its journal and from its bag.

    A line a trial: whether its files are as they were when it ended, by the sums in
    the study's journal, and whether journal, bag and the row of trials.csv are equal;
    a line a participant: how many of the notes and answers are read, and whether
    the answers are those that were given.

    Where the journal has lost rows, nothing goes on until it is restored from a
    copy, or --accept-loss writes the reason. Then "study next" takes up trials and
    answers that lack their rows; what was excluded must be excluded again. Report
    and verify name the loss.

    Exit codes
    0: all are equal, and none is lost. 1: some differ, or are lost. 2: a wrong plan, or a damaged record.
    """
    from . import overview, verify
    study = _opened(args)
    if args.accept_loss is not None:
        study.accept_loss(_reason(args.accept_loss, "--accept-loss"))
    sentences, bad = verify.verify(study, study.progress(), TOOLS["tool"]("navvi_study", "count_trial"))
    lines, counts, lost = verify.notes_and_answers(study, study.progress())
    unrecorded = study.unrecorded()
    lines += [*overview.losses(study.progress()), *unrecorded.values()]
    print("\n".join([*sentences, *lines, f"{overview.counted(len(sentences), 'trial')}, {bad} differ.",
                     f"{overview.counted(counts['notes'], 'note')} and {overview.counted(counts['answers'], 'answer')}, {lost} lost or changed."]))
    return 1 if bad or lost or unrecorded else 0


@action(PLAN, argument("--bids", action="store_true", help="the form, the one there is."))
def export(args):
    """Write the study as a data set of Motion-BIDS: each trial's way and events.

    The folder bids of the study is written anew. Nothing in it has a date.

    Exit codes
    0: written. 2: a wrong plan, or a record that cannot be read.
    """
    from . import export, overview
    study = opened(args)
    study.require_analysis()
    _written(study, export.write(study, study.progress(), export.way_of))
    agreed = [*export.agreed(study, study.progress()).values()]
    if left_out := agreed.count(False):
        print(f"navvi: left out: {left_out} of {overview.counted(len(agreed), 'participant')}, without a yes to share in the consent.")


@action(PLAN, ONLY, argument("--blind", action="store_true", help="write report-blind.html, with letters for the conditions, and no table."))
def report(args):
    """Write the study's report, one HTML file, besides its tables.

    It reports the participants, the measures by condition, the primary outcome and
    the secondary ones, corrected, apart from all exploratory comparisons.

    Exit codes
    0: written. 2: a wrong plan, or a damaged record.
    """
    study = opened(args)
    _write_report(study.blinded() if args.blind or study.concealed else study, args.only, rehearsed=False)


@action(PLAN, argument("--reason", metavar="TEXT", help="why the conditions are named before all participants are through."))
def unblind(args):
    """Freeze a blinded analysis; the reports that follow name the conditions.

    For a plan with \"blind: true\", whose reports have letters until then. The
    journal keeps the day and the SHA-256 of the blinded report of today. Before all
    participants are through it needs a reason; the report has it, and how many
    trials came after.

    Exit codes
    0: frozen, and both reports are written. 2: not blinded, or frozen before.
    """
    from .journal import sum_of
    study = opened(args)
    if not study.concealed:
        raise StudyError("there is nothing to unblind: the plan lacks \"blind: true\", or its analysis was frozen before.")
    early = not study.progress().over
    if early and not args.reason:
        raise StudyError("not all participants are through, and those who lead them would know the conditions; allowed now is with --reason.")
    reason = _reason(args.reason) if early else ""
    _write_report(study.blinded(), None, rehearsed=False)
    study.journal.append("analysis", report=sum_of(study.folder / "report-blind.html"), version=TOOLS["version"](), reason=reason)
    _write_report(study, None, rehearsed=False)


@action(PLAN, ONLY)
def rehearse(args):
    """Run the whole plan with simulated people, without ROS, and report.

    It proves that plan, record, tables and report work, in minutes; nothing is said
    by it about people. Trials and report are kept in the folder rehearsal of the
    study; a rehearsal that broke off goes on, one that is done begins anew.

    Exit codes
    0: done. 2: the plan cannot be run, and why.
    """
    from . import plan_file, rehearsal
    planned = plan_file.load(args.plan)
    _require_files(planned)
    _write_report(rehearsal.rehearse(planned, TOOLS["tool"]("navvi_study", "trials_bench"), TOOLS["version"]()), args.only, rehearsed=True)


def _require_runnable(plan):
    """Raises StudyError for what a session would refuse while the participant waits."""
    from .record import TOLD
    columns = {rule.column for rule in plan.exclusions} - {"result", *TOLD}
    known = [figure["name"] for figure in _figures()] if columns else []
    for column in sorted(columns - {*known}):
        raise StudyError(f"{plan.file}: \"exclusions\" have the column \"{column}\", which no summary has; allowed are the columns of summary.csv, "
                         f"such as {', '.join(difflib.get_close_matches(column, known, 3, 0))}.")
    _require_files(plan)
    for condition in plan.conditions:
        try:
            if condition.parameters:
                TOOLS["accept"]([f"{name}:={value}" for name, value in condition.arguments().items() if "/" in name])
        except StudyError as problem:
            raise StudyError(f"{plan.file}: condition {condition.name}: {problem}") from None


def _require_files(plan):
    """Raises StudyError for files beside the plan that a session refuses; says which questionnaires can only be typed."""
    from . import worlds
    worlds.require_files(plan, TOOLS.get("tool"))
    try:
        _require_speakable(plan)
    except StudyError as problem:
        print(f"navvi: {problem} So it can only be typed, by \"./navvi study next --typed\".")


def _require_speakable(plan):
    from . import questionnaire
    for asks in {plan.steps["consent"], *plan.asked} - {None}:
        if Path(asks.file).parent != questionnaire.SHIPPED:
            questionnaire.require_speakable(asks, TOOLS["tool"]("navvi_feedback", "feedback_node"))


def _live_session(study, typed):
    from .runner import LiveRunner
    from .session import Session
    if not typed:
        _require_speakable(study.plan)
    runner = LiveRunner(study, TOOLS["navvi"], TOOLS["tool"]("navvi_study", "close_trials"), typed)
    return Session(study, runner, wait=study.plan.operator != "simulated")


def _finished(study, name):
    """Whether nothing is left that the participant could do."""
    left = study.progress()
    return left.next(left.person(name)) is None and not left.person(name).open


def _figures():
    from . import table
    return table.figures(TOOLS["tool"]("navvi_study", "count_trial"))


def _write_report(study, only, rehearsed):
    from . import figures, report, table, worlds
    from .analysis import Analysis
    from .measures import MEASURES
    from .study import write_safely
    progress = study.progress()
    files = [] if study.letters else table.write(study, progress, _figures())
    if not only:
        files.append(report.write(study, progress, rehearsed, worlds.picture_for(study.plan, TOOLS["draw"])))
    elif only not in MEASURES or only not in (measured := Analysis(study, progress)).asked():
        raise StudyError(f"--only is \"{only}\"; allowed is a measure with values, of: {', '.join(MEASURES)}.")
    else:
        files.append(study.folder / f"{only}{'-blind' if study.letters else ''}.svg")
        write_safely(files[-1], figures.by_condition(measured, only))
    _written(study, *files)


def _written(study, *paths):
    from . import overview, verify
    for path in paths:
        print(f"navvi: written: {path}")
    if count := verify.changed(study, study.progress()):
        print(f"navvi: {overview.counted(count, 'trial')} with files that changed since the trial ended; "
              f"\"./navvi study verify {study.plan.file}\" names them.")


def _reason(words, option="--reason"):
    from . import checked, journal
    try:
        return checked.text(journal.plain(words))
    except ValueError as allowed:
        raise StudyError(f"{option} is \"{words}\"; allowed is {allowed}.") from None
