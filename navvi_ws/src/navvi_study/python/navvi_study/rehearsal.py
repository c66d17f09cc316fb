"""A whole study with simulated people, without ROS."""
import os
import shutil
from concurrent.futures import ThreadPoolExecutor

from .runner import LoopRunner
from .session import Session
from .study import Study


def rehearse(plan, trials_bench, version, say=print):
    """Returns the study that was run, in a folder of its own."""
    folder = plan.folder / "rehearsal"
    shutil.rmtree(folder, ignore_errors=True)
    study = Study(plan, folder)
    study.freeze(version, None)
    session = Session(study, LoopRunner(study, trials_bench), say=lambda line: None, wait=False)

    def live(participant):
        while session.next(participant) is not None:
            pass
        say(f"navvi: {participant} has been rehearsed.")

    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        list(pool.map(live, plan.participants))
    return study
