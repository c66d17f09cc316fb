"""The last line of a test run must be able to say that something failed."""
import pathlib
import subprocess
import sys

import pytest

SCRIPT = pathlib.Path(__file__).with_name("count_results.py")
PASSED = '<testsuite><testcase name="navvi_sim/live/world" classname="navvi_sim/live/world" status="run"/></testsuite>'
FAILED = '<testsuite><testcase name="navvi_sim/live/world" classname="navvi_sim/live/world"><failure/><system-out>signal 11</system-out></testcase></testsuite>'


@pytest.fixture
def run(tmp_path):
    """Writes ctest's file and those of the programs, and gives exit code and lines."""
    def count(ctest, *words, **written):
        (tmp_path / "ctest.xml").write_text(ctest)
        folder = tmp_path / "results" / "navvi_sim"
        folder.mkdir(parents=True)
        for name, text in written.items():
            (folder / f"live.{name}.xml").write_text(text)
        result = subprocess.run([sys.executable, str(SCRIPT), *words, str(tmp_path / "ctest.xml"), str(folder.parent)],
                                capture_output=True, text=True)
        return result.returncode, result.stdout.strip().splitlines()
    return count


def test_nothing_run_is_a_failure(run):
    code, lines = run("<testsuite/>")
    assert (code, lines[-1]) == (1, "0 passed, 0 failed")


def test_passed_failed_and_skipped_are_told_apart(run):
    code, lines = run(FAILED, world='<testsuites><testsuite><testcase name="a" status="run"/><testcase name="b"><failure/>'
                      '</testcase><testcase name="c"><skipped message="no sdformat"/></testcase></testsuite></testsuites>')
    assert (code, lines[-1]) == (1, "1 passed, 1 failed, 1 skipped")
    assert "skipped: c: no sdformat" in lines


def test_a_result_broken_off_is_a_failure(run):
    code, lines = run(PASSED, world="<testsuites><testsu")
    assert (code, lines[-1]) == (1, "0 passed, 1 failed")


def test_a_program_that_crashed_without_a_result_is_a_failure(run):
    code, lines = run(FAILED)
    assert (code, lines[-1]) == (1, "0 passed, 1 failed")
    assert "  signal 11" in lines


def test_a_program_that_crashed_after_tests_that_passed_is_a_failure(run):
    code, lines = run(FAILED, world='<testsuite><testcase name="a"/></testsuite>')
    assert (code, lines[-1]) == (1, "1 passed, 1 failed")


def test_all_passed_ends_well(run):
    code, lines = run(PASSED, world='<testsuite><testcase name="a"/></testsuite>')
    assert (code, lines[-1]) == (0, "1 passed, 0 failed")


def test_the_slowest_tests_come_first(run):
    code, lines = run(PASSED, "--slowest", world='<testsuite><testcase name="a" time="0.5"/><testcase name="b" time="7"/></testsuite>')
    assert code == 0 and [line.split()[-1] for line in lines] == ["b", "a"]
