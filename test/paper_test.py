"""The figures of the paper, and the latencies, as they stand beside ours."""
from sessions import ROOT, script

BENCH = ROOT / "navvi_ws/src/navvi_study/bench"


def test_latencies_are_whole_with_figures_of_others_beside_them_and_not_without_one():
    bench = script(BENCH / "latency_bench")
    own = {f"{name}_{figure}": "1" for name in bench.OWN for figure in ("p50_ms", "p99_ms", "max_ms", "count")}
    chain = bench.Chain("a button, to the answer", 150)
    assert not bench.whole([chain], own)
    chain.begin()
    chain.end([(chain.begun + 0.1, 'began "go on"')])
    assert chain.longest == '+100 ms began "go on"'
    assert bench.whole([chain], {**own, "learnt_count": "3"})
    assert not bench.whole([chain], {key: value for key, value in own.items() if not key.startswith("words")})


def test_each_claim_of_the_paper_names_a_test_that_is_there(capsys):
    bench = script(BENCH / "paper_bench")
    assert bench.claims() == 0
    bench.CLAIMS.append(("a claim", "Nothing.that_" + "is_tested"))
    assert bench.claims() == 1 and "THERE IS NO SUCH TEST" in capsys.readouterr().out


def test_all_constants_are_as_printed_and_one_that_differs_is_counted(capsys):
    bench = script(BENCH / "paper_bench")
    assert bench.constants() == 0
    bench.CONSTANTS[:] = [(*row, 2.0, part, name) if name == "alpha" else (*row, value, part, name) for *row, value, part, name in bench.CONSTANTS]
    assert bench.constants() == 1 and "alpha of the heuristic: 2.0, 1.0, 1.0  DIFFERS" in capsys.readouterr().out
