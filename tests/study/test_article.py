"""The article: no number in its text is typed by hand, and none that is missing goes unnoticed."""

import csv
import errno
import io
import json
import os
import re
from itertools import chain
from pathlib import Path

import pytest

from curvlib.errors import InputError
from curvlib.study import captions
from curvlib.study.article import EXCERPTS, excerpts, typeset

ROOT = Path(__file__).parents[2]
ARTICLE = ROOT / "paper/paper.typ"
ARTICLES = [ARTICLE, ROOT / "paper/frontier.typ"]
START = ROOT / "workflow/report/workflow.rst"  # of the report, no caption
CLOSING = {"(": ")", "[": "]", "{": "}"}


def pieces(source):
    """(prose, mathematics, code) of Typst markup: what a reader sees as text, each `$...$`, and
    each `#...` with all its brackets; the content blocks inside code count as markup again."""
    prose, maths, codes, at = [], [], [], 0
    while at < len(source):
        if source.startswith("//", at):
            at = source.find("\n", at) % (len(source) + 1)
        elif source[at] == "$":
            end = source.index("$", at + 1)
            maths.append(source[at : end + 1])
            at = end + 1
        elif source[at] == "#":
            statement = re.compile(r"#(let|for|if|show|import)\b").match(source, at)
            end = code_end(source, at + 1, whole_line=bool(statement))
            end += source.startswith(";", end)  # it ends the code and is not set
            codes.append(source[at:end])
            at = end
        else:
            prose.append(source[at])
            at += 1
    inner = [pieces(block) for code in codes for block in contents(code)]
    prose, maths, codes = zip(("".join(prose), maths, codes), *inner)
    return "\n".join(prose), [*chain(*maths)], [*chain(*codes)]


def code_end(source, at, whole_line):
    """Where code that begins at `at` ends: a call with its arguments, or a whole statement."""
    while at < len(source):
        if source[at] in CLOSING:
            at = bracket_end(source, at)
        elif source[at] == '"':
            at = source.index('"', at + 1) + 1
        elif (source[at] == "\n") if whole_line else not re.match(r"[\w.\-]", source[at]):
            return at
        else:
            at += 1
    return at


def bracket_end(source, at):
    close = CLOSING[source[at]]
    at += 1
    while source[at] != close:
        if source[at] in CLOSING:
            at = bracket_end(source, at)
        elif source[at] == '"' and close != "]":
            at = source.index('"', at + 1) + 1
        else:
            at += 1
    return at + 1


def contents(code):
    """The content blocks [...] in code, outermost ones."""
    at = 0
    while (at := code.find("[", at)) >= 0:
        end = bracket_end(code, at)
        yield code[at + 1 : end - 1]
        at = end


def pasted(source):
    """Numbers that are typed into the text, into its mathematics or into what shows a value."""
    prose, maths, codes = pieces(source)
    citations = r"@[\w-]+"
    found = re.findall(r"\d[\d.,]*", re.sub(citations, "", prose))
    small = {"0", "1", "2", "3", "4"}  # of formulas
    found += [n for m in maths for n in re.findall(r"\d+(?:\.\d+)?", m) if n not in small]
    shown = r"\b(?:value|fixed|percent|str)\(\s*(-?\d[\d.]*)"
    found += [n for code in codes for n in re.findall(shown, code)]
    strings = [s for code in codes for s in re.findall(r'"([^"]*)"', code)]
    numbers = [s for s in strings if re.fullmatch(r"[\d.,\N{EN DASH}\s]*\d[\d.,\N{EN DASH}\s]*", s)]
    equations = re.compile(r"3\.\d+((, |\N{EN DASH})3\.\d+)?")
    return found + [s for s in numbers if not equations.fullmatch(s)]


@pytest.mark.parametrize("path", ARTICLES, ids=lambda path: path.name)
def test_no_number_is_pasted(path):
    assert pasted(path.read_text()) == []


@pytest.mark.parametrize(
    "sentence",
    [
        "The error is 0.13 on the spout.",
        "The error is $0.13$ on the spout.",
        "It is $1.3 dot 10^(-2)$ there.",
        "#given(true)[The error is 0.13.]",
        '#ruled((1fr,), ("a",), ([0.13],), [A table.])',
        "The error is #value(0.13).",
        'The error is #text("0.13").',
        "#let a = 1\nIt is 5 times (or 6 times) larger.",
    ],
)
def test_a_pasted_number_would_be_found(sentence):
    text = ARTICLE.read_text()
    assert len(pasted(text + sentence)) > len(pasted(text))


def swallowed(source):
    """Code and mathematics with a `;` right after `#...`, which Typst takes for the end of the
    code instead of setting it."""
    _, maths, codes = pieces(source)
    in_maths = [code for m in maths for code in pieces(m.strip("$"))[2]]
    return [code for code in codes + in_maths if code.endswith(";")]


@pytest.mark.parametrize("path", sorted(ARTICLE.parent.glob("*.typ")), ids=lambda path: path.name)
def test_no_semicolon_is_swallowed(path):
    assert swallowed(path.read_text()) == []


@pytest.mark.parametrize(
    "sentence",
    [
        "#given(true)[It is best]; yet others are close.",
        "Between #value(low) and #value(high); with noise, more.",
        "#given(true)[It is #value(low); with noise, more.]",
        "#ruled((1fr,), (), ([#strong[a]; b],), [A table.])",
        "Of $#value(low); x$ only.",
        "See #name; it is best.",
    ],
)
def test_a_swallowed_semicolon_would_be_found(sentence):
    text = ARTICLE.read_text()
    assert len(swallowed(text + sentence)) == len(swallowed(text)) + 1


@pytest.mark.parametrize(
    "sentence",
    [
        "#given(true)[It is best]\\; yet others are close.",
        "#given(true)[It is best; yet others are close.]",
        "It is best (on cylinders); yet others are close [1]; see $f(x); g$.",
    ],
)
def test_a_semicolon_that_is_set_is_not_found(sentence):
    assert swallowed(sentence) == []


def test_captions_are_plain_sentences_without_numbers():
    for path in set((ROOT / "workflow/report").glob("*.rst")) - {START}:
        title, text = captions.read(path)
        assert text.endswith("."), path
        assert not title.endswith("."), path
        for words in (title, text):
            assert not re.search(r"[*`|_\\{}]|::", words), path
            allowed = re.sub(r"Figure [1-6]|\bin 2003\b|\b1/length", "", words)
            assert not re.search(r"\d", allowed), path


TABLES = {
    "tables/errors.csv": """
surface,diagonal,n,estimator,reading,quantity,norm,value
sphere,same,8,taubin,default,K,mean,0.5
sphere,same,8,watanabe,default,K,mean,0.00123
sphere,same,8,taubin,default,K,median,0.25
sphere,same,8,taubin,default,K,max,7""",
    "tables/convergence.csv": """
surface,diagonal,estimator,reading,quantity,tail,verdict,finest
sphere,same,taubin,default,K,-1.96,converges,16
sphere,random-1,taubin,default,K,-1.5,converges,8
sphere,random-2,taubin,default,K,0.1,stagnates,8
sphere,same,watanabe,default,K,,exact,16""",
    "tables/ranks.csv": """
surface,diagonal,n,reading,quantity,estimator,rank
sphere,same,8,default,K,taubin,2
sphere,same,8,best-explanation,K,taubin,5""",
    "tables/readings.csv": """
reading,estimator,variant
default,taubin,-""",
    "tables/rings.csv": """
valence,ring,quantity,estimator,variant,slope
6,regular,K,taubin,-,-2.01""",
    "tables/claims-summary.csv": """
claim,sentence,by_n,of,default_true,default_degenerate,default_undecided,default_from_24,\
default_at_finest,default_stands,best_true
1,Always best.,True,7,2,2,3,4,5,False,
2,Never best.,False,7,4,0,1,,,True,
7,Similar.,False,1,0,0,1,,,False,""",
    "tables/claims.csv": """
claim,surface,diagonal,reading,meshes,holds,from_n,effect
1,sphere,same,default,paper,true,8,0.5
1,sphere,same,default,refined,false,,2.0
1,sphere,same,best-explanation,paper,undecided,24,0.9
2,sphere,same,default,paper,degenerate,,""",
    "tables/noise.csv": """
estimator,surface,n,variant,quantity,sigma,value,response
taubin,sphere,8,-,K,0.0,0.2,0.0
taubin,sphere,8,-,K,0.01,0.25,0.125
taubin,sphere,16,-,K,0.01,0.75,0.5""",
    "tables/marginals.csv": """
option,value,claim,mean,most
dihedral,signed,2,0.5,3""",
    "tables/alternatives.csv": """
rule,dihedral
no price,signed""",
    "tables/agreement.csv": """
reading,quantity,surface,other,tau
default,K,sphere,cone,0.5""",
    "tables/guesses.csv": """
reading,family,triangles,shapes,claim_1,claim_1_degenerate,claim_2,claim_6,gauss_bonnet_H
default,all,short,12,7,0,3,1,1.75""",
    "tables/findings.json": """
{"ranking": "K is well.", "search": {"joint": 405}, "decided_by_ties": []}""",
}


@pytest.fixture
def shown(tmp_path):
    """A function that gives the text of a Typst expression on the small tables above."""
    import typst

    for name, table in TABLES.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(table.lstrip("\n") + "\n")
    for name in ("values.typ", "results.typ"):
        (tmp_path / name).write_text((ROOT / "paper" / name).read_text())
    values = {
        "labels": {"taubin": "Taubin", "sphere": "Sphere"},
        "surfaces": ["sphere"],
        "estimators": ["taubin", "watanabe"],
        "resolutions": [8],
        "cuts": ["same", "random-1", "random-2"],
        "captions": {},
        "meshes": "0123",
        "citation": str(ROOT / "CITATION.cff"),
    }

    def evaluate(expression):
        source = tmp_path / "small.typ"
        values["excerpts"] = excerpts(tmp_path / "tables", EXCERPTS)
        source.write_text(f'#import "results.typ": *\n#metadata({expression}) <shown>')
        typeset(source, tmp_path / "small.pdf", tmp_path, **values)
        inputs = {k: json.dumps(v) for k, v in values.items()} | {"results": str(tmp_path)}
        found = typst.query(str(source), "<shown>", field="value", root="/", sys_inputs=inputs)
        return json.loads(found)[0]

    evaluate.folder = tmp_path
    return evaluate


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ('error("sphere", "K", "taubin")', 0.5),
        ('value(error("sphere", "K", "taubin"))', "0.50"),
        ('slope("sphere", "K", "taubin")', -1.96),
        ('converges("sphere", "K", "watanabe")', True),
        ('converging("K", "taubin")', 1),
        ('converging("K", "taubin", kind: "random")', 0),
        ('reach("same")', 16),
        ('with-verdict(1, "true")', ["sphere"]),
        ('with-verdict(2, "degenerate")', ["sphere"]),
        ("at-finest(1)", ["sphere"]),
        ('at-finest(1, reading: "best-explanation")', ["sphere"]),
        ("at-finest(2)", []),
        ('at-finest(1, meshes: "refined")', []),
        ('with-verdict(1, "false", meshes: "refined")', ["sphere"]),
        ('effect(1, "sphere")', 0.5),
        ('tau("K", "sphere", "cone")', 0.5),
        ("alternatives.first().dihedral", "signed"),
        ('reach-of("random", "default")', 8),
        ('effect(1, "sphere", reading: "best-explanation")', 0.9),
        ('error("sphere", "K", "taubin", norm: "median")', 0.25),
        ('rank("sphere", "K", "taubin")', 2),
        ('mean-rank("K", "taubin", reading: "best-explanation")', 5),
        ('marginal("dihedral", "signed", 2)', 0.5),
        ('most("dihedral", "signed", 2)', 3),
        ('guess("claim_2", "default", triangles: "short")', 3),
        ("search.joint", 405),
        ('best("sphere", "K")', "watanabe"),
        ('ring-slope("K", "taubin", 6, "regular")', -2.01),
        ('noise("sphere", "K", "taubin", 0.01)', 0.25),
        ('noise("sphere", "K", "taubin", 0.01, n: 16)', 0.75),
        ('noise("sphere", "K", "taubin", 0.01, value: "response")', 0.125),
        ("counted(1)", {"yes": 2, "open": 3, "degenerate": 2, "of": 5}),
        ('plain(outcome(1, "default"))', "2 / 4 / 5 of 5"),
        ('outcome(2, "default")', "4 (+1) of 7"),
        ('outcome(7, "default")', "undecided"),
        ('plain(outcome(1, "best"))', "\N{EN DASH}"),
        ("stands(1)", False),
        ("stands(2)", True),
        ('name-of("taubin")', "Taubin"),
        ("value(1234.5)", "1235"),
        ("value(99.6)", "100"),
        ("value(0.0996)", "0.10"),
        ("value(-3.0)", "\N{MINUS SIGN}3.0"),
        ("value(0)", "0"),
        ("fixed(2.0, 2)", "2.00"),
        ("fixed(-0.001, 1)", "0.0"),
        ("percent(1, 3)", "33 %"),
        ("percent(1, 300)", "< 1 %"),
        ("percent(0, 300)", "0 %"),
        ("spelt(3)", "three"),
        ("spelt(12)", "twelve"),
        ("ordinal(2)", "2nd"),
        ("ordinal(4)", "4th"),
    ],
)
def test_look_ups(shown, expression, value):
    assert shown(expression) == value


def test_the_compiler_sets_an_escaped_semicolon_only(shown):
    assert shown(r"plain([#spelt(2)\; more])") == "two; more"
    assert shown("plain([#spelt(2); more])") == "two more"


def test_a_power_of_ten(shown):
    assert "1.2" in str(shown("value(0.00123)"))
    assert "\N{MINUS SIGN}3" in str(shown("value(0.00123)")) or "-3" in str(shown("value(0.00123)"))


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        ('error("cone", "K", "taubin")', "mean error cone/same/8/K/taubin/default"),
        ('slope("sphere", "K", "watanabe")', "slope sphere/same/K/watanabe/default"),
        ('rank("sphere", "K", "watanabe")', "rank sphere/8/K/watanabe"),
        ("claim(3)", "claim 3"),
        ('name-of("watanabe")', "label of watanabe"),
        ('noise("cone", "K", "taubin", 0.01)', "noise trial cone/8/K/taubin/-/0.01"),
        ('effect(2, "sphere")', "effect of claim 2/sphere/default/paper"),
        ('guess("claim_2", "other")', "claim_2 on random shapes other/all/all"),
        ('ring-slope("H", "taubin", 6, "regular")', "slope on rings 6/regular/H/taubin/-"),
        ("given(stands(1))[It is best.]", "do not bear out: It is best."),
    ],
)
def test_what_the_tables_do_not_have_ends_the_build(shown, expression, message):
    with pytest.raises(InputError, match=re.escape(message)) as raised:
        shown(expression)
    assert "\n" not in str(raised.value)
    assert not list(shown.folder.glob("*.pdf"))


def test_a_changed_table_changes_the_article(shown):
    path = shown.folder / "tables/errors.csv"
    path.write_text(path.read_text().replace("0.5", "0.7"))
    assert shown('value(error("sphere", "K", "taubin"))') == "0.70"


def test_a_mistake_in_the_source_is_shown_where_it_is(shown):
    with pytest.raises(InputError, match=r"unknown variable: slop[\s\S]*small\.typ:2"):
        shown('slop("sphere")')


def test_excerpts_are_the_rows_wanted_whatever_is_quoted(tmp_path):
    """A comma, a quote or a line break in an earlier column cuts no row."""
    rows = [
        ["reading", "sentence", "norm", "diagonal"],
        ["a", 'best, "always"', "mean", "same"],
        ["b, c", "two\nlines", "mean", "same"],
        ["mean", "same", "max", "same"],
        ["d", "", "mean", "shortest"],
    ]
    with (tmp_path / "errors.csv").open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(rows)
    found = excerpts(tmp_path, {"errors": {"norm": ["mean"], "diagonal": ["same", "random-1"]}})
    assert list(csv.reader(io.StringIO(found["errors"]))) == rows[:3]


def test_the_article_is_written_whole_or_not_at_all(tmp_path, monkeypatch):
    source, output = tmp_path / "small.typ", tmp_path / "small.pdf"
    source.write_text("Text.", encoding="utf-8")
    typeset(source, output, tmp_path)
    made = output.read_bytes()
    assert made.startswith(b"%PDF")

    def full(path, data):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(InputError, match=r"small\.pdf: No space left on device"):
        typeset(source, output, tmp_path)
    assert output.read_bytes() == made
    assert sorted(path.name for path in tmp_path.iterdir()) == ["small.pdf", "small.typ"]
