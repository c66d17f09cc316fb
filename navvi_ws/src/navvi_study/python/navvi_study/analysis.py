"""Figures of a study from its tables: by condition, paired differences, models."""
import itertools
import warnings
from dataclasses import dataclass

import numpy as np
import pandas as pd
import scipy.stats
import statsmodels.api as sm
from statsmodels.stats.multitest import multipletests
from statsmodels.tools.sm_exceptions import PerfectSeparationError

from . import measures, table
from .measures import LEAST, MEASURES, RESAMPLES

SEED = 20260101  # of the bootstrap: the same data give the same interval
LEAST_ERROR = 1e-6  # of a logarithm of a ratio, below which there is none but that of the processor's rounding
MOST_ERROR = 5.0  # of a logarithm of a ratio, beyond which there is no estimate


@dataclass
class Contrast:
    """One measure, the first condition against the second."""
    measure: str
    first: str
    second: str
    differences: pd.Series = None  # first minus second, by participant with both
    difference: float = None  # their mean
    low: float = None  # 95 % bootstrap over participants
    high: float = None
    model: str = ""
    effect: str = ""  # what the estimate is
    estimate: float = None
    estimate_low: float = None
    estimate_high: float = None
    p: float = None
    corrected: float = None
    note: str = ""
    within: float = 0.0  # of an equivalence: the plan's smallest effect of interest

    @property
    def participants(self):
        return 0 if self.differences is None else len(self.differences)

    @property
    def agreeing(self):
        """Participants whose own difference has the sign of the mean."""
        return int((self.differences * self.difference > 0).sum())


class Analysis:
    def __init__(self, study, progress):
        self.plan, self.blind = progress.plan, bool(study.letters)
        rows = [{"leg": "1", **row} for row in table.trials(study, progress) if row["counts"] in ("yes", measures.DROP_OUT)]
        self.trials = pd.DataFrame(rows, columns=list(rows[0]) if rows else ["participant", "group", "condition", "order", "result"])
        self.scores = pd.DataFrame(table.scores(study, progress), columns=["participant", "group", "condition", "order", "questionnaire", "score", "prorated"]).replace({"condition": "n/a"}, "at the end")

    def values(self, name):
        """A row a trial, or an answered questionnaire: participant, group, condition, order, value, exposure, reached."""
        measure = MEASURES[name]
        if measure.questionnaire:
            rows = self.scores[self.scores["questionnaire"] == measure.questionnaire].rename(columns={"score": "value"}).assign(exposure=1.0, reached=True)
        else:
            trials = self.trials.to_dict("records")
            rows = self.trials.assign(value=[measures.value(measure, row) for row in trials], reached=self.trials["result"] == "reached",
                                      exposure=[measures.exposure(measure, row, self.plan.exposure) for row in trials])
        rows = rows[["participant", "group", "condition", "order", "value", "exposure", "reached"]].dropna(subset=["value", "exposure"])
        return rows.astype({"value": float, "exposure": float, "order": int})

    def unit(self, name):
        return measures.unit(name, self.plan.exposure)

    def prorated(self, name):
        """How many scores of the measure leave an item out."""
        return int(self.scores.loc[self.scores["questionnaire"] == MEASURES[name].questionnaire, "prorated"].sum())

    def alike(self, name):
        """Whether all trials have the same value: nothing to draw or to compare."""
        values = self.values(name)
        return np.ptp(values["value"] / values["exposure"]) == 0

    def asked(self):
        """Names of all measures that have values."""
        return [name for name in MEASURES if len(self.values(name))]

    def by_condition(self, name):
        """A row a group and condition: participants, trials, mean, SD and median of the participants' means, and for times how many trials
        were not reached."""
        rows = []
        for (group, condition), part in self.values(name).groupby(["group", "condition"], sort=False):
            means = by_participant(part)[condition]
            low, high = interval(means.to_numpy())
            rows.append({"group": group, "condition": condition, "participants": len(means), "trials": len(part), "mean": means.mean(),
                         "low": low, "high": high, "sd": means.std(ddof=1), "median": means.median(), "unfinished": int((~part["reached"]).sum())})
        names = [condition.name for condition in self.plan.conditions]
        return sorted(rows, key=lambda row: (row["group"], names.index(row["condition"]) if row["condition"] in names else len(names)))

    def contrast(self, name, first, second, within=0.0):
        """\\param within  above 0: whether the two are equivalent, by two one-sided tests, instead of whether they differ"""
        values = self.values(name)
        values = values[values["condition"].isin([first, second])]
        means = by_participant(values).dropna()
        result = Contrast(name, first, second, within=within)
        if means.empty or not {first, second} <= set(means):
            result.note = "nobody has both conditions"
            return result
        result.differences = means[first] - means[second]
        differences = result.differences.to_numpy()
        result.difference = differences.mean()
        result.low, result.high = interval(differences)
        if result.participants < LEAST:
            result.note = f"fewer than {LEAST} participants: no interval and no test"
            return result
        values = values[values["participant"].isin(means.index)]
        if within:
            result.note = _late(name, values)
            return _equivalence(result, differences)
        values = values.assign(first=lambda rows: (rows["condition"] == first).astype(float))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                MODELS[MEASURES[name].kind](result, values, differences)
        except (ValueError, np.linalg.LinAlgError, ZeroDivisionError, PerfectSeparationError) as problem:
            result.note = f"the model cannot be estimated: {problem}"
        estimates = [result.p] if result.estimate is None else [result.p, result.estimate, result.estimate_low, result.estimate_high]
        if result.p is not None and not np.isfinite(estimates).all():
            result.p = result.estimate = result.estimate_low = result.estimate_high = None
            result.note = "the model cannot be estimated from these data"
        differ = ""
        if result.p is not None and result.low is not None and (result.low > 0 or result.high < 0) != (result.p < 0.05):
            differ = ("the interval excludes 0, and p is not below 0.05" if result.p >= 0.05 else "p is below 0.05, and the interval holds 0")
            differ += ": mean and model differ here, and p decides"
        result.note = "; ".join(filter(None, [result.note, _late(name, values), differ]))
        return result

    def confirmatory(self):
        """The primary contrast, and the secondary ones with p corrected by Holm."""
        primary = self._of(self.plan.primary)
        primary.corrected = primary.p  # one outcome: nothing to correct
        return primary, corrected([self._of(question) for question in self.plan.secondary], "holm")

    def exploratory(self):
        """All that was not asked for before and differs in anybody, with p corrected by Benjamini and Hochberg."""
        asked = {(one.measure, frozenset((one.first, one.second))) for one in self._questions()}
        contrasts = [self.contrast(name, *pair) for name in self.asked() for pair in self.pairs(name) if (name, frozenset(pair)) not in asked]
        return corrected([one for one in contrasts if one.participants and one.differences.any()], "fdr_bh")

    def pairs(self, name):
        """All that is compared by the measure, each pair once and in the plan's order: as the outcome of this measure names it, else as
        another outcome does, else as the group has its conditions."""
        planned = {frozenset((one.first, one.second)): (one.first, one.second)
                   for one in sorted(self._questions(), key=lambda one: one.measure == name)}
        pairs = dict.fromkeys(frozenset(pair) for group in self.plan.groups for pair in itertools.combinations(group.conditions, 2))
        listed = {frozenset(pair): pair for group in reversed(self.plan.groups)
                  for pair in itertools.combinations(sorted(group.conditions) if self.blind else group.conditions, 2)}
        return [planned.get(pair, listed[pair]) for pair in pairs]

    def _questions(self):
        return (self.plan.primary, *self.plan.secondary)

    def _of(self, question):
        return self.contrast(question.measure, question.first, question.second, question.within)


def _late(name, values):
    """Of a time: how many trials enter the mean with the limit."""
    late = values[~values["reached"]].groupby("condition").size()
    words = " and ".join(f"{count} in {condition}" for condition, count in late.items())
    return f"trials that ended at the limit, and enter the mean with it: {words}" if words and MEASURES[name].kind == "time" else ""


def by_participant(values):
    """A row a participant, a column a condition: the mean of the trials, of counts their sum over that of the exposures."""
    sums = values.groupby(["participant", "condition"])[["value", "exposure"]].sum()
    return (sums["value"] / sums["exposure"]).unstack()


def interval(values):
    """95 % of the mean, by bootstrap of the participants; None for fewer than LEAST, or where all are alike: these tell of no spread."""
    if len(values) < LEAST or np.ptp(values) == 0:
        return None, None
    source = np.random.default_rng(SEED)
    means = values[source.integers(0, len(values), (RESAMPLES, len(values)))].mean(axis=1)
    return tuple(np.percentile(means, [2.5, 97.5]))


def corrected(contrasts, method):
    """All of them are of the family: one that could not be tested counts as p = 1."""
    if contrasts:
        for one, p in zip(contrasts, multipletests([1.0 if one.p is None else one.p for one in contrasts], method=method)[1]):
            one.corrected = None if one.p is None else p
    return contrasts


def _predictors(values):
    """The condition, and its place in the order, where the two conditions do not lie equally far apart for all: in one order for all the two
    predictors would be one."""
    columns = {"const": 1.0, "first": values["first"]}
    places = values.groupby(["participant", "first"])["order"].mean().unstack()
    if (places[1.0] - places[0.0]).nunique() > 1:
        columns["order"] = values["order"] - values["order"].mean()
    return pd.DataFrame(columns, index=values.index)


def _ratio(result, model, effect, estimate, error, p, quantile=1.96):
    """\\param quantile  of the estimate's distribution, for 95 %"""
    result.model, result.effect, result.p = model, effect, float(p)
    result.estimate, result.estimate_low, result.estimate_high = (float(np.exp(estimate + shift * error)) for shift in (0, -quantile, quantile))


def _of_few(fit, values):
    """Estimate, error, p and quantile of a GEE with few participants: its errors after Mancl and DeRouen (Biometrics 57, 2001), which do not
    come out too small, and Student's distribution with as many degrees of freedom as participants beyond the model's terms."""
    free = max(1, values["participant"].nunique() - len(fit.params))
    estimate, error = fit.params["first"], fit.bse["first"]
    if not error > LEAST_ERROR:
        raise ValueError("all participants differ alike between the conditions")
    return estimate, error, 2 * scipy.stats.t.sf(abs(estimate / error), free), scipy.stats.t.ppf(0.975, free)


def _count(result, values, differences):
    """Negative binomial by GEE, participants as clusters, over the exposure. It begins at a Poisson model, which gives its dispersion by the
    method of moments: a likelihood has no maximum where counts vary less than Poisson's, and where its search ends is the processor's."""
    predictors, exposure, counts = _predictors(values), values["exposure"].to_numpy(), values["value"].to_numpy()
    if counts.sum() == 0:
        raise ValueError("nothing was counted")
    if values.groupby("first")["value"].sum().min() == 0:
        result.note = "nothing was counted under one of the conditions, so that no ratio can be estimated"
        return _number(result, values, differences)
    plain = sm.GLM(counts, predictors, family=sm.families.Poisson(), exposure=exposure).fit()
    expected, free = plain.fittedvalues.to_numpy(), max(1, len(values) - predictors.shape[1])
    dispersion = float(np.clip(((counts - expected) ** 2 - expected) @ expected ** -2 / free, 1e-3, 10.0))
    fit = sm.GEE(counts, predictors, groups=values["participant"], family=sm.families.NegativeBinomial(alpha=dispersion),
                 cov_struct=sm.cov_struct.Exchangeable(), exposure=exposure).fit(cov_type="bias_reduced", start_params=plain.params.to_numpy())
    return _ratio(result, "negative binomial, GEE by participant", "rate ratio", *_of_few(fit, values))


def _time(result, values, _):
    """Cox, stratified by participant; who did not arrive is censored at the limit."""
    reached = values["reached"].astype(int)
    if reached.groupby(values["first"]).sum().min() == 0:
        return _log_rank(result, values, reached, "nobody arrived under one of the conditions")
    predictors = _predictors(values).drop(columns="const")
    fit = sm.PHReg(values["value"], predictors, status=reached, strata=values["participant"], ties="efron").fit()
    at = list(predictors).index("first")
    if not np.isfinite([fit.params[at], fit.bse[at]]).all() or fit.bse[at] > MOST_ERROR:
        return _log_rank(result, values, reached, "the times of (nearly) all participants differ in one direction")
    return _ratio(result, "Cox, stratified by participant, censored at the limit", "hazard ratio of arriving", fit.params[at], fit.bse[at], fit.pvalues[at])


def _log_rank(result, values, reached, why):
    """The stratified log-rank test, for a ratio that has no bound: p has.
    \\param why  it has none, in words"""
    if not reached.any():
        raise ValueError("nobody arrived")
    model = sm.PHReg(values["value"], values[["first"]], status=reached, strata=values["participant"], ties="efron")
    score, information = float(model.score(np.zeros(1))[0]), -float(model.hessian(np.zeros(1))[0, 0])
    if information <= 0:
        raise ValueError("no two times of a participant can be compared")
    result.model, result.p = "log-rank test, stratified by participant", float(scipy.stats.chi2.sf(score ** 2 / information, 1))
    result.note = f"{why}, so that no ratio can be estimated"


def _share(result, values, differences):
    """Logistic by GEE, participants as clusters."""
    if values.groupby("first")["value"].mean().isin([0.0, 1.0]).any():
        result.note = "all or none under one of the conditions, so that no ratio can be estimated"
        return _number(result, values, differences)
    fit = sm.GEE(values["value"], _predictors(values), groups=values["participant"], family=sm.families.Binomial(),
                 cov_struct=sm.cov_struct.Exchangeable()).fit(cov_type="bias_reduced")
    return _ratio(result, "logistic, GEE by participant", "odds ratio", *_of_few(fit, values))


def _equivalence(result, differences):
    """Two one-sided t tests of the participants' differences against the smallest effect of interest (Schuirmann, Journal of Pharmacokinetics
    and Biopharmaceutics 15, 1987); the interval of 90 % is that of the same two tests."""
    free, error = len(differences) - 1, differences.std(ddof=1) / np.sqrt(len(differences))
    result.model, result.effect, result.estimate = f"two one-sided t tests within {result.within:g}", "mean difference", float(differences.mean())
    result.p = float(scipy.stats.t.sf((result.within - abs(result.estimate)) / error, free)) if error else float(abs(result.estimate) >= result.within)
    result.estimate_low, result.estimate_high = (float(result.estimate + sign * scipy.stats.t.ppf(0.95, free) * error) for sign in (-1, 1))
    return result


def _number(result, values, differences):
    """Wilcoxon's signed ranks of the participants' differences, with the estimate of Hodges and Lehmann."""
    if not np.any(differences):
        raise ValueError("no difference in any participant")
    walsh = np.sort([(one + other) / 2 for at, one in enumerate(differences) for other in differences[at:]])
    result.model, result.effect, result.p = "Wilcoxon signed ranks", "Hodges-Lehmann shift", float(scipy.stats.wilcoxon(differences).pvalue)
    count = len(differences)
    spread = 1.96 * np.sqrt(count * (count + 1) * (2 * count + 1) / 24)
    rank = int(max(0, np.floor(count * (count + 1) / 4 - spread)))
    result.estimate, result.estimate_low, result.estimate_high = float(np.median(walsh)), float(walsh[rank]), float(walsh[-1 - rank])


MODELS = {"count": _count, "time": _time, "share": _share, "number": _number}
