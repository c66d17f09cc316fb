"""A whole study with simulated people, without ROS."""
import os
import shutil
from concurrent.futures import ThreadPoolExecutor

from .errors import StudyError
from .runner import LoopRunner
from .session import Session
from .study import Study


def rehearse(plan, trials_bench, version, say=print):
    """Returns the study that was run, in a folder of its own. One that broke off goes on; one that is done begins anew."""
    folder = plan.folder / "rehearsal"
    if not _goes_on(plan, folder, version):
        shutil.rmtree(folder, ignore_errors=True)
    study = Study(plan, folder)
    if study.progress().freezes:
        say("navvi: the rehearsal that broke off goes on.")
    else:
        study.freeze(version, None)
    session = Session(study, LoopRunner(study, trials_bench, version), say=lambda line: None, wait=False)

    def live(participant):
        while session.next(participant) is not None:
            pass
        say(f"navvi: {participant} has been rehearsed.")

    # What fails in one participant fails the rehearsal, once the others are through.
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        list(pool.map(live, plan.participants))
    return study


def _goes_on(plan, folder, version):
    """Whether a rehearsal of this plan, by this version, was begun and is not done."""
    if not (folder / "journal.jsonl").is_file():
        return False
    try:
        study = Study(plan, folder)
        progress, lost = study.progress(), study.unrecorded()
    except StudyError:  # damaged
        return False
    frozen = progress.freezes
    same = bool(frozen) and not lost and (frozen[-1]["plan"], frozen[-1]["version"]) == (plan.hash(), version)
    return same and not all(progress.complete(person) for person in progress.people.values())
