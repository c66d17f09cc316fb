"""The last line of a test run must be able to say that something failed."""
import contextlib
import os
import re
import subprocess
import sys

import pytest

import count_results
import run_tests
import sessions
from sessions import ROOT

SCRIPT = ROOT / "test/count_results.py"
PASSED = '<testsuite><testcase name="navvi_sim/live/world" classname="navvi_sim/live/world" status="run"/></testsuite>'
FAILED = '<testsuite><testcase name="navvi_sim/live/world" classname="navvi_sim/live/world"><failure/><system-out>signal 11</system-out></testcase></testsuite>'
NOT_RUN = PASSED.replace("</testsuite>", '<testcase name="navvi_sim/live/hall" status="notrun"><skipped message="{}"/></testcase></testsuite>')


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


@pytest.mark.parametrize("ctest, written, code, said", [
    pytest.param("<testsuite/>", {}, 1, ["0 passed, 0 failed"], id="nothing_run_is_a_failure"),
    pytest.param(FAILED, {"world": '<testsuites><testsuite><testcase name="a" status="run"/><testcase name="b"><failure/></testcase>'
                          '<testcase name="c"><skipped message="no sdformat"/></testcase></testsuite></testsuites>'},
                 1, ["1 passed, 1 failed, 1 skipped", "skipped: c: no sdformat"], id="passed_failed_and_skipped_are_told_apart"),
    pytest.param(PASSED, {"world": "<testsuites><testsu"}, 1, ["0 passed, 1 failed"], id="a_result_broken_off_is_a_failure"),
    pytest.param(FAILED, {}, 1, ["0 passed, 1 failed", "  signal 11"], id="a_crash_without_a_result_is_a_failure"),
    pytest.param(FAILED, {"world": '<testsuite><testcase name="a"/></testsuite>'}, 1, ["1 passed, 1 failed"], id="a_crash_after_tests_that_passed_is_a_failure"),
    pytest.param(PASSED, {"world": '<testsuite><testcase name="a"/></testsuite>'}, 0, ["1 passed, 0 failed"], id="all_passed_ends_well"),
    pytest.param(NOT_RUN.format("Unable to find executable"), {"world": '<testsuite><testcase name="a"/></testsuite>'},
                 1, ["1 passed, 1 failed", "  Unable to find executable"], id="what_could_not_be_run_is_a_failure"),
    pytest.param(NOT_RUN.format("other programs held 90% of this machine"), {"world": '<testsuite><testcase name="a"/></testsuite>'},
                 0, ["1 passed, 0 failed, 1 skipped"], id="what_is_left_out_is_counted"),
])
def test_the_last_line_counts_what_came_of_the_programs(run, ctest, written, code, said):
    ended, lines = run(ctest, **written)
    assert (ended, lines[-1]) == (code, said[0]) and set(said) <= set(lines)


def test_the_slowest_tests_come_first(run):
    code, lines = run(PASSED, "--slowest", world='<testsuite><testcase name="a" time="0.5"/><testcase name="b" time="7"/></testsuite>')
    assert code == 0 and [line.split()[-1] for line in lines] == ["b", "a"]


@pytest.fixture
def run_ctest(tmp_path, monkeypatch, capsys):
    """run_tests.py on real tests, which are lines of sh; what it prints, and {program: (outcome, reason)}."""
    def run(busy, *words, **programs):
        (tmp_path / "CTestTestfile.cmake").write_text("".join(f'add_test({name} "sh" "-c" "{line}")\n' for name, line in programs.items()))
        monkeypatch.setattr(run_tests, "BUSY", busy)
        monkeypatch.setattr(sys, "argv", ["run_tests.py", str(tmp_path / "results.xml"), *words])
        monkeypatch.chdir(tmp_path)
        run_tests.main()
        return capsys.readouterr().out, {name: (outcome, why) for name, outcome, why, _ in count_results.cases(tmp_path / "results.xml")}
    return run


def test_what_fails_in_a_crowd_is_run_again_alone_and_named_with_the_reason(run_ctest):
    told, found = run_ctest(2.0, "-j2", steady="true", crowd="test -e seen || { touch seen; echo 'E   assert 1'; exit 1; }", wrong="exit 1")
    assert "run again, alone: crowd\n  E   assert 1\n" in told and told.count("Start") == 5, told
    assert {name: outcome for name, (outcome, _) in found.items()} == {"steady": "passed", "crowd": "passed", "wrong": "failed"}


def test_what_fails_alone_is_not_run_again(run_ctest):
    told, found = run_ctest(2.0, wrong="exit 1")
    assert found["wrong"][0] == "failed" and told.count("Start") == 1, told


def test_what_fails_where_others_hold_the_processors_is_left_out_unless_it_fails_alike_each_time(run_ctest):
    loops = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(2 * os.cpu_count())]
    try:
        late = "date '+E   %N s late'; sleep 1; exit 1"
        measured = "date '+E   assert 0.%N < 0.5 in /tmp/pytest-of-a/pytest-%N/b'; sleep 1; exit 1"
        _, found = run_ctest(run_tests.BUSY, steady="true", late=late, wrong="echo 'E   at 0x7f'; sleep 1; exit 1", measured=measured)
        assert sessions.crowd() > 1.0
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()
    outcomes = {"steady": "passed", "late": "skipped", "wrong": "failed", "measured": "failed"}
    assert {name: outcome for name, (outcome, _) in found.items()} == outcomes, found
    assert re.match(r"other programs held (\d\d|100)% of this machine's processors", found["late"][1])


@pytest.mark.parametrize("one, other, alike", [
    ("E   assert 12.25 == 3", "E   assert 1e-07 == 3", True), ("E   at 0x7f12ab", "E   at 0xab", True),
    ("E   /tmp/pytest-7/a", "E   /tmp/pytest-18/a", True), ("[  FAILED  ] A.b (300 ms)", "[  FAILED  ] A.b (12 ms)", True),
    ("E   held after 0.31 s", "E   held after 1.02 s", False), ("E   300 ms late", "E   12 ms late", False),
    ("E   still, beside 2.5 a processor", "E   still, beside 3.5 a processor", False), ("E   assert 3 == 4", "E   assert 3 != 4", False)])
def test_failures_are_alike_where_only_what_is_measured_differs_but_for_wall_time(one, other, alike):
    assert (run_tests.CHANCE.sub("", one) == run_tests.CHANCE.sub("", other)) == alike


@pytest.mark.parametrize("seconds, beside, why", [
    (1.0, 0.0, None), (1.1, 0.9, r"lost, beside 0\.9 a processor(?!:)"), (1.9, 1.1, None), (1.9, 9.0, None),
    (2.1, 3.0, r"lost, beside 3\.0 a processor(?!:)"), (2.1, 9.0, "lost, beside 9.0 a processor: too busy to judge")])
def test_a_bound_counts_twice_beside_a_load_and_never_more(seconds, beside, why, monkeypatch):
    monkeypatch.setattr(sessions, "crowd", lambda: beside)
    with pytest.raises(AssertionError, match=why) if why else contextlib.nullcontext():
        sessions.within(lambda *_: None, "lost", seconds, 1.0)
