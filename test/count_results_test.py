"""The last line of a test run must be able to say that something failed."""
import pathlib
import subprocess
import sys

SCRIPT = pathlib.Path(__file__).with_name("count_results.py")


def count(folder):
    result = subprocess.run([sys.executable, str(SCRIPT), str(folder)], capture_output=True, text=True)
    return result.returncode, result.stdout.strip().splitlines()[-1]


def test_nothing_run_is_a_failure(tmp_path):
    assert count(tmp_path) == (1, "0 passed, 0 failed")


def test_passed_failed_and_skipped_are_told_apart(tmp_path):
    (tmp_path / "a.xml").write_text(
        '<testsuites><testsuite><testcase name="a" status="run"/><testcase name="b"><failure/></testcase>'
        '<testcase name="c"><skipped/></testcase></testsuite></testsuites>')
    assert count(tmp_path) == (1, "1 passed, 1 failed, 1 skipped")


def test_a_result_broken_off_is_a_failure(tmp_path):
    (tmp_path / "a.xml").write_text("<testsuites><testsu")
    assert count(tmp_path) == (1, "0 passed, 1 failed")


def test_all_passed_ends_well(tmp_path):
    (tmp_path / "a.xml").write_text('<testsuite><testcase name="a"/></testsuite>')
    assert count(tmp_path) == (0, "1 passed, 0 failed")
