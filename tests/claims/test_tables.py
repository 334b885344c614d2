"""Claims from the published tables: what a study lacks, what explains it, sums and words."""

import itertools

import numpy as np
import pandas as pd
import pytest

from curvlib.claims import answer, summary
from curvlib.claims.cell import FAVOURITES, NINE, SEVEN
from curvlib.claims.evidence import decide
from curvlib.claims.explanations import (
    BEST,
    alternatives,
    best,
    departures,
    explain,
    marginals,
    with_best,
)
from curvlib.claims.explanations import search as found_by
from curvlib.claims.guesses import guesses
from curvlib.claims.sentences import CLAIMS
from curvlib.comparison import accuracy


def tables(names=NINE, surfaces=("sphere", "cone", "ellipsoid"), factor=lambda key, n: 1.0):
    """The tables of a study of made-up errors: estimator k of the nine has k / n^2, the favourites
    the least, times `factor` of the row."""
    order = sorted(NINE, key=lambda name: (name not in FAVOURITES.values(), name))
    readings = pd.DataFrame(
        {"reading": "default", "kind": "named", "estimator": name, "variant": "-"}
        | {"counted": "interior", "more": False}
        for name in names
    )
    places = [(s, q, e) for s in surfaces for q in FAVOURITES for e in names]
    variants = pd.DataFrame(
        {"surface": s, "diagonal": "same", "n": n, "estimator": e, "variant": "-", "quantity": q}
        | {"counted": "interior", "full": True, "paper": True, "rounding": 1e-9, "vertices": n * n}
        | {"mean": (1 + order.index(e)) / n**2 * factor((s, q, e), n)}
        for s, q, e in places
        for n in (8, 16, 32)
    )
    noise = pd.DataFrame(
        {"surface": s, "n": 16, "quantity": q, "estimator": e, "variant": "-", "sigma": sigma}
        | {"response": (1 + order.index(e)) * sigma}
        for s, q, e in places
        for sigma in (0, 0.01)
    )
    rings = pd.DataFrame(
        {"valence": 6, "ring": "regular", "quantity": q, "estimator": e, "variant": "-"}
        | {"order": 2.0, "order_low": 2.0, "order_high": 2.0, "verdict": "converges"}
        for q in FAVOURITES
        for e in names
    )
    curves = accuracy.curves(variants, readings)
    return {
        "readings": readings,
        "variants": variants,
        "curves": curves,
        "noise": noise,
        "rings": rings,
    }


def test_claims_are_decided_from_the_tables_alone():
    decided = decide(**tables())
    assert set(decided.meshes[decided.surface != "quadric"]) == {"paper"}
    on_sphere = decided[decided.surface == "sphere"].set_index("claim")
    # Gauss-Bonnet is before paraboloid everywhere and nothing stagnates.
    assert on_sphere.holds.to_dict() == {
        **{1: "true", 2: "false", 3: "false", 4: "true", 5: "false", 6: "true"},
        **{8: "true", 9: "true", 10: "true", 11: "false", 12: "false"},
    }
    assert on_sphere.effect[2] == pytest.approx(2)
    assert on_sphere.from_n[1] == 8
    together = decided[decided.claim == 7]
    assert together[["surface", "holds", "effect"]].to_numpy().tolist() == [["all", "undecided", 1]]
    quadric = decided[decided.surface == "quadric"]
    assert quadric[["claim", "diagonal", "meshes", "holds"]].to_numpy().tolist() == [
        [8, "valence-6-regular", "refined", "true"]
    ]


@pytest.mark.parametrize("lost", ["gauss_bonnet", "paraboloid", "taubin"])
def test_a_claim_about_an_estimator_that_is_not_in_the_study_is_undecided(lost):
    decided = decide(**tables([name for name in NINE if name != lost]))
    missing = decided[decided.evidence == f"not in this study: {lost}"]
    about = {1, 2, 3, 5, 6, 7, 10, 11, 12}
    about |= {4, 8} if lost in FAVOURITES.values() else set()
    about |= {9} if lost == "paraboloid" else set()
    assert set(missing.claim) == about
    assert set(missing.holds) == {"undecided"}
    assert missing[["effect", "from_n"]].isna().all(axis=None)
    assert set(decided.drop(missing.index).holds) <= {"true"}


def test_the_order_of_the_tables_rows_decides_nothing():
    one = tables()
    other = {
        name: table.sample(frac=1, random_state=1) if name != "readings" else table[::-1]
        for name, table in one.items()
    }
    key = ["claim", "surface", "diagonal", "reading"]
    one, other = (decide(**t).sort_values(key, ignore_index=True) for t in (one, other))
    pd.testing.assert_frame_equal(one, other)


def test_no_one_gains_by_failing():
    """An estimator that leaves out the vertices where it is worst has the least mean; its rank is
    not compared, and claims about the ranking there are undecided."""
    study = tables()
    variants = study["variants"]
    cheats = (variants.estimator == "taubin") & (variants.surface == "sphere")
    variants.loc[cheats, "mean"] /= 1000
    variants.loc[cheats, "vertices"] -= 1
    decided = decide(**study)
    by_claim = decided[decided.claim.isin([1, 2, 3, 6, 10, 11])]
    assert set(by_claim.holds[by_claim.surface == "sphere"]) == {"undecided"}
    assert "undecided" not in set(by_claim.holds[by_claim.surface == "cone"])


def test_the_paper_s_meshes_and_finer_ones_are_decided_apart():
    """Up to n = 32 paraboloid converges, up to n = 256 it does not; what is true of the first is
    not lost to the second, and a reading without finer meshes has no refined row."""
    study = tables(factor=lambda key, n: (n / 8) ** 2 if n > 32 else 1.0)
    finer = study["variants"][study["variants"].n == 32]
    finer = pd.concat(
        finer.assign(n=n, paper=False, full=False, mean=finer["mean"] / 4) for n in (64, 128, 256)
    )
    study["variants"] = pd.concat([study["variants"], finer], ignore_index=True)
    single = study["readings"].assign(reading="other", kind="single")
    more = study["readings"].assign(more=True)
    study["readings"] = pd.concat([more, single], ignore_index=True)
    study["curves"] = accuracy.curves(study["variants"], study["readings"])
    decided = decide(**study)
    four = decided[(decided.claim == 4) & (decided.surface == "sphere")]
    assert four[["reading", "meshes", "holds"]].to_numpy().tolist() == [
        ["default", "paper", "true"],
        ["default", "refined", "false"],
        ["other", "paper", "true"],
    ]
    row = summary.summary(decided, study["readings"]).set_index("claim").loc[4]
    assert (row.default_true, row.default_refined_true, row.of) == (3, 0, 3)
    assert row.turned_over_by == ""


def test_from_24_on_is_about_resolutions_that_are_there():
    """It holds where the first n >= 24 is reached, and nowhere without one."""
    for last, true in (([32], True), ([12], False)):
        study = tables()
        rows = study["variants"]
        rows.loc[rows.n == 32, "n"] = last[0]
        worse = (rows.estimator == "gauss_bonnet") & (rows.n < last[0])
        rows.loc[worse, "mean"] *= 9
        study["curves"] = accuracy.curves(rows, study["readings"])
        decided = decide(**study)
        one = decided[(decided.claim == 1) & (decided.surface == "sphere")].iloc[0]
        assert bool(one.from_24) is true


def joint(choices):
    """Readings of a search, one for each of the options given."""
    rows = [
        {"reading": ",".join(f"{o}={v}" for o, v in choice.items()), "kind": "product"}
        | {"estimator": e, "variant": variant(e, choice), "counted": "interior", "more": False}
        for choice in choices
        for e in NINE
    ]
    return pd.DataFrame(rows)


def variant(estimator, choice):
    return choice["dihedral"] if estimator == "gauss_bonnet" else "-"


def search(signs=("signed", "as-printed"), worse=9.0):
    """A search with one reading in which Gauss-Bonnet is best for K and paraboloid for H, and one
    in which Gauss-Bonnet is best for both."""
    study = tables(surfaces=SEVEN)
    rows = study["variants"]
    mine = rows.estimator == "gauss_bonnet"
    printed = rows[mine].assign(variant="as-printed")
    printed["mean"] *= np.where(printed.quantity == "H", worse, 1)
    rows = pd.concat([rows[~mine], rows[mine].assign(variant="signed"), printed])
    readings = joint([{"area": "third", "dihedral": sign} for sign in signs])
    return readings, explain(readings, rows, accuracy.curves(rows, readings))


def test_the_best_explanation_is_searched():
    readings, explanations = search()
    by_claim = explanations.set_index(["dihedral", "claim"])
    levels = ["at_finest", "from_24", "always", "degenerate", "of"]
    assert by_claim.loc[("as-printed", 1), levels].tolist() == [7, 7, 7, 0, 7]
    assert by_claim.loc[("as-printed", 2), levels].tolist() == [7, 7, 7, 0, 7]
    assert by_claim.loc[("signed", 2), levels].tolist() == [0, 0, 0, 0, 7]
    # 21 each for claims 1, 2 and 6; one departure for A/3, one more for the signed angle.
    assert by_claim.loc[("as-printed", 1), "score"] == 3 * 21 - 1
    assert by_claim.loc[("signed", 1), "score"] == 2 * 21 - 2
    assert best(explanations) == {"area": "third", "dihedral": "as-printed"}
    told = found_by(explanations)
    assert told["options"] == best(explanations)
    assert (told["joint"], told["departures"], told["score"]) == (2, 1, 62)
    assert (told["equals"], told["prices"]) == ([], [0, 1, 2, 3, 4, 5])
    assert told["neighbours"] == {"dihedral=signed": {"claim_1": 7, "claim_2": 0, "claim_6": 7}}
    assert told["always"] == {"claim_1": 7, "claim_2": 7, "claim_6": 7}
    named = with_best(readings, explanations)
    of_gauss_bonnet = named[(named.reading == BEST) & (named.estimator == "gauss_bonnet")]
    assert of_gauss_bonnet[["kind", "variant", "more"]].to_numpy().tolist() == [
        ["named", "as-printed", True]
    ]
    assert len(named) == len(readings) + 9
    # The winner is found: where the printed angle does no good, it is the other.
    _, otherwise = search(worse=1.0)
    assert best(otherwise)["dihedral"] == "as-printed", "an equal score and one departure less"
    summed = marginals(explanations).set_index(["option", "value", "claim"])
    assert summed.loc[("dihedral", "as-printed", 2)].tolist() == [7, 7, 7, 7]
    assert summed.loc[("area", "third", 2)].tolist() == [3.5, 7, 3.5, 7]


def test_freedom_is_not_free():
    printed = {"normal": "uniform", "paraboloid_normal": "uniform", "pairs": "opposite"}
    printed |= {"area": "half", "dihedral": "as-printed"}
    assert departures(printed) == 0
    assert departures(printed | {"area": "third"}) == 1
    assert departures(printed | {"area": "mixed"}) == 2
    assert departures(printed | {"normal": "area", "paraboloid_normal": "area"}) == 1
    assert departures(printed | {"normal": "area"}) == 2
    # An option of one estimator costs what that of all does.
    for option, value in (("pairs", "all"), ("dihedral", "signed"), ("area", "mixed")):
        assert departures({f"some_{option}": value}) == departures({option: value}) > 0
    assert departures({"paraboloid_normal": "uniform"}) == 0
    assert departures({"paraboloid_normal": "area"}) == 1
    _, explanations = search()
    # At a price above what claim 2 gains, the other would win if it departed less.
    dear = explanations.assign(
        departures=np.where(explanations.dihedral == "signed", 0, explanations.departures)
    )
    assert best(dear, price=1)["dihedral"] == "as-printed"
    assert best(dear, price=100)["dihedral"] == "signed"


@pytest.mark.parametrize("kept", [NINE[:5], NINE])
def test_without_joint_readings_or_the_nine_there_is_no_explanation(kept):
    study = tables(kept)
    found = explain(study["readings"], study["variants"], study["curves"])
    assert best(found) == found_by(found) == {}
    assert marginals(found).empty
    assert BEST not in set(with_best(study["readings"], found).reading)
    if kept is not NINE:
        readings = joint([{"area": "third", "dihedral": "-"}])
        readings = readings[readings.estimator.isin(kept)]
        found = explain(readings, study["variants"], study["curves"])
        assert best(found) == {}


def decided_rows(counts, surfaces=SEVEN):
    """Rows of claims.csv for all claims: (reading, meshes, diagonal) -> verdicts on surfaces."""
    return pd.DataFrame(
        {"claim": number, "surface": surface, "diagonal": diagonal, "reading": reading}
        | {"meshes": meshes, "holds": holds, "from_n": 24 if holds in "true undecided" else np.nan}
        | {"from_24": holds in "true undecided", "effect": 1.0, "evidence": ""}
        for (reading, meshes, diagonal), verdicts in counts.items()
        for number, claim in CLAIMS.items()
        for surface, holds in zip(["all"] if claim.together else surfaces, verdicts)
    )


READINGS = pd.DataFrame(
    [("default", "named"), (BEST, "named"), ("loose", "single"), ("tight", "single")],
    columns=["reading", "kind"],
)
T, U, F, D = "true", "undecided", "false", "degenerate"


def some_claims(best_true=5):
    return decided_rows(
        {
            ("default", "paper", "same"): [T, T, T, D, D, U, F],
            ("default", "refined", "same"): [T, U, F, D, D, U, F],
            ("default", "refined", "random-1"): [F, T, F, F, F, T, T],
            ("default", "refined", "alternate"): [T, T, U, T, T, T, T],
            (BEST, "paper", "same"): [T] * best_true + [F] * (7 - best_true),
            ("loose", "paper", "same"): [F, F, F, D, D, U, F],
            ("tight", "paper", "same"): [T, T, T, D, D, F, F],
        }
    )


def test_summary_counts_each_kind_of_mesh_apart():
    table = summary.summary(some_claims(), READINGS)
    row = table.iloc[0]
    verdicts = ("true", "degenerate", "undecided", "false")
    assert [row[f"default_{v}"] for v in verdicts] == [3, 2, 1, 1]
    assert [row[f"default_refined_{v}"] for v in verdicts] == [1, 2, 2, 2]
    # In the worst of the two cuts.
    assert [row[f"default_cuts_{v}"] for v in verdicts] == [3, 0, 0, 4]
    assert row[f"{BEST}_true"] == 5
    # Three of the five that are not degenerate; with `loose` none of them.
    assert row.default_stands
    assert row.default_from_24 == row.default_at_finest == 4
    assert row.turned_over_by == "loose"
    assert row.turned_over_on == "random-1"
    together = table[table.claim == 7].iloc[0]
    assert (together.of, together.default_true) == (1, 1)
    shown = summary.verdicts(some_claims(), SEVEN[:3])
    assert set(shown.meshes) == {"paper"}
    by_default = shown[shown.reading == "default"].set_index(["claim", "surface"]).holds
    assert by_default[1].to_dict() == dict.fromkeys(SEVEN[:3], T)
    assert by_default[7].to_dict() == {"all": T}


def convergence(converging):
    """convergence.csv where (cut, reading, estimator) -> surfaces on which it does not converge."""
    return pd.DataFrame(
        {"surface": s, "diagonal": cut, "estimator": e, "reading": r, "quantity": q}
        | {"verdict": "stagnates" if s in converging.get((cut, r, e), SEVEN) else "converges"}
        for s, cut, r, e, q in itertools.product(
            SEVEN,
            ("jittered-1", "jittered-2", "random-1", "alternate"),
            ("default", "exact-normals"),
            NINE,
            "KH",
        )
    )


NONE = convergence({})


def test_the_answer_follows_the_tables():
    """Counts, and sentences that say otherwise where the claims come out otherwise."""
    _, explanations = search()
    table = summary.summary(some_claims(), READINGS)
    elsewhere = summary.on_other_cuts(some_claims())
    found = answer.findings(table, found_by(explanations), NONE, elsewhere)
    text = answer.answer(table, found, 256)
    lines = [[cell.strip() for cell in line.split("|")] for line in text.splitlines()]
    lines = [cells for cells in lines if len(cells) > 4]
    assert lines[0][3:7] == [
        "on the paper's meshes",
        "refined to n = 256",
        "on every other cut",
        "best explanation",
    ]
    # Always, from n = 24 on, at the finest; what is not true in the made-up claims holds from 24.
    assert lines[2][3:7] == ["3 / 4 / 4 of 5", "1 / 3 / 3 of 5", "3 of 7", "5 / 5 / 5 of 7"]
    assert lines[5][3:7] == ["3 (+1) of 5", "1 (+2) of 5", "3 of 7", "5 of 7"]
    assert lines[8][3:7] == ["yes", "yes", "no", "yes"]
    head = " ".join(text.split("\n\n")[0].split())
    assert head.startswith("**The answer**: for K in part, at fine resolutions, for H in part, at")
    assert "explains the paper best: for K in part" in head
    words = answer.in_words(table)
    assert words.count("\n") == len(CLAIMS)
    assert "3 (+1) of 5 on the paper's meshes, 1 (+2) of 5 refined" in words
    assert "changes with loose" in words
    plain = table.drop(columns=[c for c in table if BEST in c])
    none = answer.answer(plain, answer.findings(plain, {}, NONE, elsewhere), 64)
    assert "explains" not in none
    assert "refined to n = 64" in none
    assert none.count("\n* ") == 2


def test_findings_in_studies_that_come_out_otherwise():
    _, explanations = search()
    elsewhere = {"at_finest": {}, "whole_ranking": []}

    def found(best_true=5, rows=explanations, kept=NONE, cuts=elsewhere):
        table = summary.summary(some_claims(best_true), READINGS)
        return answer.findings(table, found_by(rows), kept, cuts)

    assert "for H on 4 of 5 surfaces at the finest resolution, and on 3" in found()["ranking"]
    assert "cut otherwise" not in found()["ranking"]
    cuts = {"at_finest": {"random-1": {"claim_2": 2}, "alternate": {"claim_2": 7}}}
    assert "it is on up to 7 (alternate)." in found(cuts=cuts)["ranking"]
    assert "A search of all 2 joint readings" in found()["explanation"]
    assert "(3.13) literally as printed" in found()["explanation"]
    assert "for H at every resolution on 5 of 7 surfaces" in found()["explanation"]
    assert "on none of 7 surfaces, not even at the finest" in found(0)["explanation"]
    signed = explanations[explanations.dihedral == "signed"]
    assert "the signed angle at each edge" in found(rows=signed)["explanation"]
    # Without one of the nine it is not said who is the best of them.
    assert set(found(kept=NONE[NONE.estimator != "taubin"]).values()) == {""}


def test_what_the_advice_on_H_needs_is_looked_up():
    """A misprint is blamed only where it is in the winner, and where without it or without the
    loose pairs the claim is lost."""
    searched = {
        "options": {"dihedral": "as-printed", "pairs": "all"},
        "neighbours": {"dihedral=signed": {"claim_2": 0}, "pairs=opposite": {"claim_2": 1}},
    }
    row = {f"{BEST}_at_finest": 5}
    needed = answer._needed(searched, row)
    assert "misprint" in needed
    assert "with the signed angle paraboloid fitting is the best on none, with opposite" in needed
    assert needed.count("pairs on 1.") == 1
    assert answer._needed(searched | {"options": {"dihedral": "signed"}}, row) == ""
    enough = searched["neighbours"] | {"pairs=opposite": {"claim_2": 4}}
    assert answer._needed(searched | {"neighbours": enough}, row) == ""
    assert answer._needed(searched | {"neighbours": {}}, row) == ""


@pytest.mark.parametrize(
    ("verdicts", "word"),
    [
        ([T] * 7, "yes"),
        ([T, D, T, T, D, T, T], "yes"),
        ([U, U, U, U, F, F, F], "in part, at fine resolutions"),
        ([U, U, U, F, F, F, F], "no"),
        ([U, D, F, F, D, D, D], "no"),
        ([D] * 7, "nothing to rank"),
    ],
)
def test_the_answer_in_one_word(verdicts, word):
    rows = summary.summary(decided_rows({("default", "paper", "same"): verdicts}), READINGS[:1])
    assert (
        answer.headline(rows.to_dict("records")) == f"**The answer**: for K {word}, for H {word}."
    )


def test_the_ranking_on_other_cuts():
    found = summary.on_other_cuts(some_claims())
    assert found["at_finest"]["alternate"] == {"claim_1": 7, "claim_2": 7, "claim_6": 7}
    assert found["at_finest"]["random-1"]["claim_2"] == 3
    places = [place for place in found["whole_ranking"] if place[1] == "alternate"]
    assert places == [["default", "alternate", s] for s in sorted(SEVEN) if s != "sphere"]


def test_other_rules_of_scoring_are_tried():
    _, explanations = search()
    table = alternatives(explanations).set_index("rule")
    assert set(table.dihedral) == {"as-printed"}
    assert table.loc["claim 2", "claim_2"] == 7
    # Equal winners have a row each: both angles do as well where H does not count.
    _, otherwise = search(worse=1.0)
    assert len(alternatives(otherwise).query("rule == 'no price'")) == 2
    assert alternatives(explanations[:0]).empty
    nothing = explanations.assign(**dict.fromkeys(("at_finest", "from_24", "always"), 0))
    assert alternatives(nothing).empty


def test_without_one_of_the_seven_nothing_is_searched():
    study = tables(surfaces=("mine",))
    readings = joint([{"area": "third", "dihedral": "-"}])
    found = explain(readings, study["variants"], study["curves"])
    assert best(found) == {}


def test_a_missing_error_has_no_rank_on_random_shapes():
    study = tables(surfaces=("arc-00", "arc-01"))
    shapes = study["variants"].assign(family="arc", elongation=2.0)
    shapes = shapes[shapes.n == 32]
    whole = guesses(shapes, study["readings"]).iloc[0]
    assert (whole.shapes, whole.gauss_bonnet_H) == (2, 1)
    last = shapes.estimator == "gauss_bonnet"
    shapes.loc[last, "mean"] *= 100
    assert guesses(shapes, study["readings"]).gauss_bonnet_H.iloc[0] == 9
    shapes.loc[last & (shapes.surface == "arc-00"), "vertices"] -= 1
    assert guesses(shapes, study["readings"]).gauss_bonnet_H.iloc[0] == 9
    shapes.loc[last, "vertices"] = 0
    assert guesses(shapes, study["readings"]).gauss_bonnet_H.isna().all()


def test_a_search_over_one_option():
    _, explanations = search()
    one = explanations.drop(columns="area")
    assert best(one) == {"dihedral": "as-printed"}
    assert found_by(one)["neighbours"]["dihedral=signed"]["claim_2"] == 0
    assert found_by(one)["equals"] == []
    assert set(alternatives(one).dihedral) == {"as-printed"}
    assert set(marginals(one).option) == {"dihedral"}


def test_what_converges_on_irregular_meshes_is_looked_up():
    assert answer.irregular(NONE).count("none of the nine") == 4
    cuts = {(cut, "exact-normals", "paraboloid"): () for cut in ("jittered-1", "jittered-2")}
    one = answer.irregular(convergence(cuts))
    assert "normals, paraboloid fitting alone with exact ones. With these, none of the nine" in one
    # For every seed, and on every surface.
    for spoilt in ({("jittered-2", "exact-normals", "paraboloid"): ("cone",)}, {}):
        kept = dict(list(cuts.items())[:1]) | spoilt
        assert answer.irregular(convergence(kept)).count("none of the nine") == 4
    both = convergence(cuts | {(c, r, "taubin"): () for c, r, _ in cuts})
    assert "paraboloid fitting and Taubin's method alone" in answer.irregular(both)
    assert answer.irregular(NONE[NONE.estimator != "taubin"]) == ""
    assert answer.irregular(NONE[NONE.diagonal != "alternate"]) == ""
    assert answer.irregular(NONE[NONE.surface != "cone"]) == ""


def test_agreement_is_blank_where_there_is_nothing_to_rank():
    study = tables(surfaces=SEVEN)
    rows = study["variants"]
    zero = (rows.surface == "cone") & (rows.quantity == "K")
    rows.loc[zero, "mean"] = 1e-12
    found = summary.agreement(study["readings"], rows).set_index(["quantity", "surface", "other"])
    assert len(found) == 2 * 7 * 7
    assert found.tau["H"].tolist() == [1.0] * 49
    blank = found.tau["K"].isna()
    assert blank.sum() == 13
    assert blank["cone"].all()


def test_verdicts_that_depend_on_the_tolerance_of_a_tie_are_found():
    study = tables(surfaces=SEVEN)
    rows = study["variants"]
    assert summary.decided_by_ties(study["readings"], rows) == []
    close = (rows.surface == "cone") & (rows.quantity == "K") & (rows.estimator == "gauss_bonnet")
    rows.loc[close, "mean"] *= 2 * 1.04
    assert summary.decided_by_ties(study["readings"], rows) == [("default", "K", "cone")]
