"""The frozen plan in words, as a registry asks for it: hypotheses, design, participants, measures, analysis, exclusions."""
import json
from types import SimpleNamespace

from . import overview
from .measures import LEAST, MEASURES, RESAMPLES, sample_size, unit
from .steps import KINDS
from .study import write_safely

MODELS = {
    "time": "Times: Cox's proportional hazards, stratified by participant, censored at the limit; where no ratio can be estimated, the log-rank test.",
    "count": "Counts: negative binomial by generalized estimating equations, a participant as cluster, with the errors of Mancl and DeRouen and "
             "Student's distribution; where nothing was counted in a condition, Wilcoxon's signed ranks.",
    "share": "Shares: logistic by generalized estimating equations, likewise; where all or none are in a condition, Wilcoxon's signed ranks.",
    "number": "Scores and ratios: Wilcoxon's signed ranks of each participant's means, with the shift of Hodges and Lehmann.",
}
EQUIVALENCE = "Equivalence: two one-sided t tests of the participants' differences (Schuirmann), with their 90 % interval."


def write(study):
    """The page of the plan that was frozen last. Returns the file."""
    path = study.folder / "preregistration.md"
    # As attributes, like a Plan's; keys that a freeze leaves out have their default.
    usual = {"exposure": "trial", "blind": False, "at_begin": [], **{kind.key: None for kind in KINDS if kind.key}}
    plan = json.loads(json.dumps({**usual, **study.frozen()}), object_hook=lambda values: SimpleNamespace(**values))
    write_safely(path, "\n".join(page(plan, study.progress().freezes)) + "\n")
    return path


def page(plan, freezes):
    """Lines of Markdown."""
    outcomes = [plan.primary, *plan.secondary]
    kinds = {MEASURES[one.measure].kind for one in outcomes if not getattr(one, "within", 0)}
    sections = {
        "Hypotheses": [
            f"Primary: {hypothesis(plan, plan.primary)}", *[f"Secondary: {hypothesis(plan, one)}" for one in plan.secondary],
            "Differences are tested two-sided at 5 %; equivalence by two one-sided tests at 5 %."],
        "Design": [
            "Each participant drives in all conditions of the group.", *overview.conditions(plan), *overview.balance(plan),
            f"Each condition has a set of {len(plan.sets[0])} worlds; sets go round the conditions by a Latin square. A trial ends at the goal or after {plan.limit:g} s.",
            f"Sessions: {plan.sessions}. Calibration: {'yes' if plan.calibrate else 'no'}. Learning of a person's delay: {plan.learning}."],
        "Participants": [
            *[f"Group {group.name}: {len(group.participants)}, in the conditions {', '.join(group.conditions)}." for group in plan.groups],
            *sample(plan),
            f"Nobody begins once {plan.stop_after} have completed the study." if plan.stop_after else "The study ends when all have taken part.",
            f"Consent: {plan.consent.title}." if plan.consent else "The plan asks for no consent."],
        "Measures": [
            *dict.fromkeys(f"{MEASURES[one.measure].label}, {unit(one.measure, plan.exposure)}, of {MEASURES[one.measure].of}." for one in outcomes),
            *[f"Questionnaire: {one.title}." for one in (*plan.at_begin, *plan.after_condition, *plan.at_end)]],
        "Analysis": [
            *[words for kind, words in MODELS.items() if kind in kinds],
            *([EQUIVALENCE] if any(getattr(one, "within", 0) for one in outcomes) else []),
            "Models hold the place of the condition in the order, unless all drive in one order.",
            f"Beside each stands the mean of the paired differences with its 95 % interval, a bootstrap of participants ({RESAMPLES} draws).",
            f"Below {LEAST} participants there is neither interval nor test.",
            "The primary outcome is not corrected, the secondary ones are by Holm; all else is exploratory, corrected by Benjamini and Hochberg. "
            "What cannot be tested counts as p = 1 in both.",
            *(["Reports have letters for the conditions until the analysis is frozen."] if plan.blind else [])],
        "Exclusions": overview.broken_off(plan),
        "Changes since the plan was frozen first": [f"{row['utc'][:10]}, {row['reason']}: {change}" for row in freezes for change in row["changes"]],
    }
    for section, sentence in (told for kind in KINDS for told in kind.registered(plan)):
        sections[section].append(sentence)
    lines = [f"# {plan.title}: pre-registration", "",
             f"Study {plan.study}; the plan was frozen on {freezes[-1]['utc'][:10]} as {freezes[-1]['plan']}, with NavVI {freezes[-1]['version']}."]
    for heading, sentences in sections.items():
        lines += ["", f"## {heading}", "", *[f"- {sentence}" for sentence in sentences]] if sentences else []
    return lines


def sample(plan):
    """A sentence on the primary outcome; none where the plan has no effect and variance."""
    one, planned = plan.primary, sum(len(group.participants) for group in plan.groups)
    sd, within = getattr(one, "sd", 0), getattr(one, "within", 0)
    if not sd:
        return []
    effect = within or one.effect
    few, many = (sample_size(effect, sd, power, bool(within)) for power in (0.8, 0.9))
    return [f"Sample size: {'equivalence within' if within else 'a difference of'} {effect:g} ({unit(one.measure, plan.exposure)}), where "
            f"participants' differences have an SD of {sd:g}, is shown with 80 % power by {few} participants, with 90 % by {many}; {planned} are planned."]


def hypothesis(plan, one):
    within = getattr(one, "within", 0)
    return (f"{MEASURES[one.measure].label}: {one.first} and {one.second} "
            + (f"are equivalent within {within:g} ({unit(one.measure, plan.exposure)})." if within else "differ."))
