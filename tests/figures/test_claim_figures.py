"""The figures of the claims: verdicts by surface, agreement of rankings, marginals of options."""

import itertools
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_hex
from matplotlib.patches import Ellipse, Rectangle

from curvlib.catalogue import surfaces
from curvlib.claims.cell import NINE, SEVEN
from curvlib.claims.sentences import CLAIMS
from curvlib.figures.agreement import agreement_plot
from curvlib.figures.marginals import MEAN, RING, WINNER, marginals_plot
from curvlib.figures.style import save
from curvlib.figures.verdicts import CELLS, claims_map
from curvlib.study.readings import choices_of

SURFACES = ["cylinder", "sphere", "teapot"]
LABELS = ("Cylinder", "Sphere", "Spout of a teapot")
MODULES = {name: SimpleNamespace(LABEL=label) for name, label in zip(SURFACES, LABELS)}
SENTENCES = {
    1: "The first is the best of the nine for K, always.",
    2: "Its error falls as O(h^2).",
    6: "The other is always second, a stride behind the first.",
    7: "The ranking is similar on all of them.",
}
SUMMARY = pd.DataFrame(SENTENCES.items(), columns=["claim", "sentence"])
READINGS = {"default": "default reading", "best": "best explanation"}


def texts(axes):
    return [text.get_text() for text in axes.texts]


def hatched(axes):
    return [patch for patch in axes.patches if patch.get_hatch()]


def decided(readings):
    """Rows of claims.csv: every verdict, and one on all surfaces together."""
    verdicts = {
        (1, "cylinder"): ("degenerate", np.nan),
        (1, "sphere"): ("undecided", 24),
        (1, "teapot"): ("true", 8),
        (2, "cylinder"): ("false", np.nan),
        (2, "sphere"): ("undecided", np.nan),
        (2, "teapot"): ("true", 8),
        (7, "all"): ("undecided", np.nan),
    }
    return pd.DataFrame(
        {"reading": r, "claim": c, "surface": s, "holds": h, "from_n": n}
        for r in readings
        for (c, s), (h, n) in verdicts.items()
    )


@pytest.mark.parametrize("readings", [["default"], ["default", "best"]])
def test_claims_map_has_a_verdict_in_every_cell(readings, printed):
    titles = {reading: READINGS[reading] for reading in readings}
    figure = claims_map(decided(readings), SUMMARY, titles, SURFACES, MODULES)
    printed(figure)
    assert len(figure.axes) == len(readings), "a panel per reading"
    for axes, title in zip(figure.axes, titles.values()):
        signs = ["", "≥24", "yes", "no", "?", "yes", "undecided"]
        assert texts(axes) == [*signs, title]
        assert [patch.get_width() > 2 for patch in axes.patches] == [False] * 6 + [True]
        fills = [to_hex(patch.get_facecolor()).upper() for patch in axes.patches]
        kinds = ("true", "from some n on", "undecided", "false")
        wanted = {kind: CELLS[kind][0]["facecolor"].upper() for kind in kinds}
        assert fills[1:] == [
            wanted[kind]
            for kind in ("from some n on", "true", "false", "undecided", "true", "undecided")
        ]
        assert hatched(axes) == axes.patches[:1], "nothing to rank is none of these"
        places = [(patch.get_x() // 1, patch.get_y() // 1) for patch in axes.patches]
        assert places == [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1), (0, 2)]
    first = figure.axes[0]
    labels = [" ".join(t.get_text().split()) for t in first.get_yticklabels()]
    assert labels == [f"{c}. {SENTENCES[c]}".replace("^2", "²") for c in (1, 2, 7)]
    heads = [" ".join(t.get_text().split()) for t in first.get_xticklabels()]
    assert heads == list(LABELS)
    legend = [t.get_text() for t in figure.legends[0].get_texts()]
    assert len(legend) == len(CELLS)


def test_claims_map_of_one_surface(printed):
    """As narrow as the words allow, with the legend below."""
    rows = decided(["default"])
    rows = rows[rows.surface.isin(["sphere", "all"])]
    figure = claims_map(rows, SUMMARY, {"default": "default reading"}, ["sphere"], MODULES)
    printed(figure)
    assert texts(figure.axes[0])[:3] == ["≥24", "?", "?"]


def agreement(tau, readings=("default",)):
    """Rows of agreement.csv: `tau` of (quantity, surface, other)."""
    return pd.DataFrame(
        {"reading": r, "quantity": q, "surface": s, "other": o, "tau": tau(q, s, o)}
        for r in readings
        for q, s, o in itertools.product("KH", SURFACES, SURFACES)
    )


def without_cylinder(quantity, surface, other):
    if quantity == "K" and "cylinder" in (surface, other):
        return np.nan
    return 1 if surface == other else -0.25 if quantity == "H" else 0.75


@pytest.mark.parametrize("readings", [["default"], ["default", "best"]])
def test_agreement_has_a_number_for_each_two_surfaces(readings, printed):
    titles = {reading: READINGS[reading] for reading in ("default", "best")}
    figure = agreement_plot(agreement(without_cylinder, readings), titles, SURFACES, MODULES)
    printed(figure)
    *panels, bar = figure.axes
    assert len(panels) == 2 * len(readings), "K and H side by side"
    for of_K, of_H in zip(panels[::2], panels[1::2]):
        assert texts(of_K) == ["0.75"]
        assert [(p.get_x() // 1, p.get_y() // 1) for p in hatched(of_K)] == [(0, 0), (0, 1)]
        assert texts(of_H) == ["\N{MINUS SIGN}0.25"] * 3
        assert not hatched(of_H)
        (blue,) = {p.get_facecolor() for p in of_K.patches} - {
            p.get_facecolor() for p in hatched(of_K)
        }
        (red,) = {p.get_facecolor() for p in of_H.patches}
        assert blue[2] > blue[0]
        assert red[0] > red[2], "other colours on the two sides of zero"
    heads = [axes.get_title(loc="left") for axes in panels]
    assert heads == [f"{q}, {READINGS[r]}" for r in readings for q in "KH"]
    assert bar.get_xlim() == (-1, 1)


@pytest.mark.parametrize("surfaces", [SURFACES, ["sphere"]])
def test_agreement_of_a_study_without_rankings(surfaces, printed):
    figure = agreement_plot(agreement(without_cylinder).head(0), READINGS, surfaces, MODULES)
    printed(figure)
    assert [t.get_text() for t in figure.texts] == ["no two rankings of the nine in this study"]


OPTIONS = {"normal": ["uniform", "area"], "pairs": ["opposite", "all"]}
OPTIONS |= {"dihedral": ["signed", "unsigned", "as-printed"]}
DEFAULT = {option: values[0] for option, values in OPTIONS.items()}
BEST = {"normal": "area", "pairs": "all", "dihedral": "signed"}


def marginals():
    """marginals.csv and explanations.csv, in which claim 2 holds on more surfaces with each later
    value, and claim 1 can be ranked on five of seven."""
    joint = [dict(zip(OPTIONS, values)) for values in itertools.product(*OPTIONS.values())]
    explanations = pd.DataFrame(
        choice
        | {"claim": claim, "at_finest": sum(OPTIONS[o].index(v) for o, v in choice.items())}
        | {"degenerate": 2 if claim == 1 else 0, "of": 7}
        for choice in joint
        for claim in (1, 2)
    )
    found = []
    for by in (["normal"], ["pairs"], ["dihedral"], ["pairs", "dihedral"]):
        for (*values, claim), rows in explanations.groupby([*by, "claim"], sort=False):
            place = {"option": " x ".join(by), "value": " x ".join(values), "claim": claim}
            found.append(place | {"mean": rows.at_finest.mean(), "most": rows.at_finest.max()})
    return pd.DataFrame(found), explanations


@pytest.mark.parametrize("winner", [BEST, {}])
def test_marginals_have_a_row_per_value_with_the_default_ringed(winner, printed):
    table, explanations = marginals()
    figure = marginals_plot(table, explanations, SENTENCES, DEFAULT, winner)
    printed(figure)
    behind, first, second, matrix = figure.axes
    rows = {t.get_text(): t.get_position()[1] for t in behind.texts}
    values = [value for values in OPTIONS.values() for value in values]
    assert [v for v in rows if v in values] == values
    single = table[~table.option.str.contains(" x ")]
    for axes, claim in zip((first, second), (1, 2)):
        of_claim = single[single.claim == claim].set_index("value")
        dots = {y: x for x, y in points(axes, MEAN)}
        assert dots == {rows[v]: of_claim["mean"][v] for v in values}
        bars = [patch for patch in axes.patches if not patch.get_hatch()]
        assert [bar.get_width() for bar in bars] == [of_claim.most[v] for v in values]
        middles = [bar.get_y() + bar.get_height() / 2 for bar in bars]
        assert middles == pytest.approx([rows[v] for v in values])
        rings = {y: x for x, y in points(axes, RING)}
        assert rings == {rows[v]: of_claim["mean"][v] for v in DEFAULT.values()}
    (beyond,) = hatched(first)
    assert (beyond.get_x(), beyond.get_width()) == (5, 2)
    assert hatched(second)[0].get_width() == 0
    bands = [patch.get_y() + 0.45 for patch in behind.patches]
    assert bands == pytest.approx(sorted(rows[v] for v in winner.values()))
    legend = [t.get_text() for t in figure.legends[0].get_texts()]
    assert ("the value in the best explanation" in legend) == bool(winner)

    numbers = dict(zip(map(tuple, (t.get_position() for t in matrix.texts)), texts(matrix)))
    assert numbers[0.5, 0.5] == "0.5 (1)"
    assert numbers[2.5, 1.5] == "3.5 (4)"
    assert len(numbers) == 6
    (ring,) = (p for p in matrix.patches if isinstance(p, Ellipse))
    assert tuple(ring.center) == (0.5, 0.5), "opposite, signed"
    edge = [p.get_xy() for p in matrix.patches if framed(p)]
    assert [(x // 1, y // 1) for x, y in edge] == ([(0, 1)] if winner else []), "all, signed"


def points(axes, style):
    """The points drawn in a style."""
    drawn = [x for x in axes.lines if x.get_markersize() == style["markersize"]]
    return [tuple(point) for line in drawn for point in line.get_xydata()]


def framed(patch):
    colour = to_hex(patch.get_edgecolor()).upper()
    return isinstance(patch, Rectangle) and colour == WINNER["edgecolor"]


def test_marginals_of_few_options_and_claims(printed):
    """Without both decisive options there is no matrix, and neither with one claim."""
    table, explanations = marginals()
    alone = table[table.option == "normal"]
    for rows, claims in ((alone, (1, 2)), (table, (1,))):
        sentences = {claim: SENTENCES[claim] for claim in claims}
        figure = marginals_plot(rows, explanations, sentences, DEFAULT, {})
        printed(figure)
        assert len(figure.axes) == 1 + len(claims)


def test_marginals_of_a_study_without_joint_readings(printed):
    table, explanations = (frame.head(0) for frame in marginals())
    figure = marginals_plot(table, explanations, SENTENCES, DEFAULT, {})
    printed(figure)
    assert [t.get_text() for t in figure.texts] == ["this study has no joint readings"]


def test_the_paper_s_claims_are_legible_in_print(printed):
    """With all twelve sentences, all seven surfaces and every option of the nine."""
    summary = pd.DataFrame([claim._asdict() for claim in CLAIMS.values()])
    summary = summary.rename(columns={"number": "claim"})
    modules = surfaces.modules({name: name for name in SEVEN})
    cells = [(c.number, "all" if c.together else s) for c in CLAIMS.values() for s in SEVEN]
    rows = pd.DataFrame(dict.fromkeys(cells), index=["x"]).T.reset_index()
    rows = rows.set_axis(["claim", "surface", "holds"], axis=1)
    rows = rows.assign(holds="undecided", from_n=50.0, reading="default")
    rows = pd.concat([rows, rows.assign(reading="best")])
    printed(claims_map(rows, summary, READINGS, SEVEN, modules))

    tau = pd.DataFrame(itertools.product(READINGS, "KH", SEVEN, SEVEN))
    tau = tau.set_axis(["reading", "quantity", "surface", "other"], axis=1).assign(tau=-0.25)
    printed(agreement_plot(tau, READINGS, SEVEN, modules))

    names = ("normal", "paraboloid_normal", "pairs", "area", "dihedral")
    choices = {option: choices_of(NINE)[option] for option in names}
    single = [(option, value) for option in names for value in choices[option]]
    crossed = itertools.product(choices["pairs"], choices["dihedral"])
    single += [("pairs x dihedral", " x ".join(pair)) for pair in crossed]
    table = pd.DataFrame(
        {"option": option, "value": value, "claim": claim, "mean": 3.5, "most": 7}
        for option, value in single
        for claim in (1, 2, 6, 11)
    )
    of = pd.DataFrame({"claim": [1, 2, 6, 11], "degenerate": 2, "of": 7})
    sentences = {claim: CLAIMS[claim].sentence for claim in (1, 2, 6, 11)}
    values = {option: values[-1] for option, values in choices.items()}
    printed(marginals_plot(table, of, sentences, values, values))


@pytest.mark.parametrize("kind", ["svg", "png"])
def test_hatched_figures_have_the_same_bytes_each_time(tmp_path, kind):
    made = []
    for name in "ab":
        path = tmp_path / f"{name}.{kind}"
        save(claims_map(decided(["default"]), SUMMARY, READINGS, SURFACES, MODULES), path)
        made.append(path.read_bytes())
    assert made[0] == made[1]
