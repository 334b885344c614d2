"""What the report adds: captions and labels in words, the answer, tables as pages, a script."""

import base64
import gzip
import json
import re
from pathlib import Path

import pytest
import snakemake.report

from curvlib.errors import InputError
from curvlib.study import captions, report

FOLDER = Path(__file__).parents[2] / "workflow/report"
CAPTION = captions.Caption("A <title>", "Plain & short.")


@pytest.mark.parametrize(
    ("name", "file", "shown"),
    [
        ("error-K-cone", "error-K", {"quantity": "Gaussian curvature K", "surface": "Cone"}),
        ("error-H-a-pipe", "error-H", {"quantity": "mean curvature H", "surface": "Pipe"}),
        ("ranks-H", "ranks", {"quantity": "mean curvature H"}),
        ("figure-3", "figure-3", {}),
        ("table-claims-summary", "table-claims-summary", {}),
        ("table-claims", "table-claims", {}),
    ],
)
def test_labels_in_words(name, file, shown):
    path = captions.found(name, FOLDER)
    assert path.stem == file
    labels = captions.labels(name, path, {"cone": "Cone", "a-pipe": "Pipe"})
    assert labels == {"what": captions.read(path).title} | shown


def test_what_a_name_has_beyond_its_kind_follows_the_title(tmp_path):
    path = tmp_path / "curve-claim.rst"
    path.write_text("Curve of claim\n==============\n\nOne\ncurve.\n")
    assert captions.found("curve-claim-4", tmp_path) == path
    assert captions.read(path) == ("Curve of claim", "One curve.")
    assert captions.labels("curve-claim-4", path, {}) == {"what": "Curve of claim 4"}


def test_equal_labels_are_told_apart():
    assert captions.distinct({"a": "Pipe", "b": "Cone", "c": "Pipe"}) == {
        "a": "Pipe (a)",
        "b": "Cone",
        "c": "Pipe (c)",
    }


@pytest.mark.parametrize(
    "text", ["Plain sentences\nalone.\n", "Title\n====\n\nText.\n", "\n\nText."]
)
def test_a_caption_without_a_title(tmp_path, text):
    path = tmp_path / "error.rst"
    path.write_text(text)
    with pytest.raises(InputError, match=r"error\.rst: line 2 has to underline the title"):
        captions.read(path)
    with pytest.raises(InputError, match=r"figure 'ranks-K' has no caption: write .*ranks-K\.rst"):
        captions.found("ranks-K", tmp_path)


def test_the_answer_is_html():
    table = "|   | says  | holds |\n|:--|:------|:------|\n| 1 | O(h^2) | 2 (+1) of 7 |"
    found = report.answer(f"* **K** < H\n  by <b>`a=b`</b>.\n* So.\n\n{table}\n| 2 | b | no |\n")
    assert found.startswith(
        "<ul>\n<li><strong>K</strong> &lt; H\nby &lt;b&gt;<code>a=b</code>&lt;/b&gt;.</li>"
    )
    rows = re.findall("<tr>(.*?)</tr>", found, re.S)
    assert [re.findall("<t[hd].*?>(.*?)</t[hd]>", row) for row in rows] == [
        ["", "says", "holds"],
        ["1", "O(h²)", "2 (+1) of 7"],
        ["2", "b", "no"],
    ]
    assert re.search('<div class="wide" tabindex="0"><table>.*</table></div>', found, re.S)


def shown_by(page):
    """What a page of a table unpacks."""
    (data,) = re.findall('<script id="data" type="text/plain">(.*)</script>', page)
    return json.loads(gzip.decompress(base64.b64decode(data)))


def test_a_page_holds_its_table_and_needs_no_network(tmp_path):
    table = tmp_path / "claims.csv"
    table.write_text(
        'claim,surface,evidence\n1,cone,"n = 50, </script> {{DATA}} \N{MINUS SIGN}1"\n'
    )
    summary = tmp_path / "summary.csv"
    summary.write_text("claim,sentence\n1,O(h^2) it is.\n")
    template = (FOLDER / "table.html").read_text()
    sentences = report.sentences(summary)
    page = report.page(template, table, CAPTION, {"cone": "Cone"}, sentences)
    assert shown_by(page) == {
        "columns": ["claim", "surface", "evidence"],
        "rows": [["1", "cone", "n = 50, </script> {{DATA}} \N{MINUS SIGN}1"]],
        "names": {"cone": "Cone"},
        "sentences": {"1": "1. O(h²) it is."},
    }
    assert (
        "<h1>A &lt;title&gt;</h1>\n<p>Plain &amp; short. The file is tables/claims.csv.</p>" in page
    )
    assert not re.search(r"{{|https?:|\bsrc=|\bhref=|@import|url\(", page)
    assert report.page(template, table, CAPTION, {"cone": "Cone"}, sentences) == page


def test_the_script_comes_last(tmp_path):
    made, script = tmp_path / "report.html", tmp_path / "report.js"
    made.write_text("<body><p>'</body>'</p>\n</body>\n</html>")
    script.write_text("run();\n")
    report.add_script(made, script)
    assert made.read_text() == (
        "<body><p>'</body>'</p>\n<script>\nrun();\n</script>\n</body>\n</html>"
    )


def test_snakemake_has_what_the_script_changes():
    template = Path(snakemake.report.__file__).parent / "html_reporter/template/components"
    sources = "\n".join(path.read_text() for path in template.glob("*.js"))
    classes = dict(re.findall(r"^class (\w+)[^{]*{(.*?)^}", sources, re.M | re.S))
    script = (FOLDER / "report.js").read_text()
    changed = re.findall(r"^(\w+)\.prototype\.(\w+) = function", script, re.M)
    assert {name for name, _ in changed} >= {"ContentDisplay", "Icon", "RuleInfo"}
    for name, method in changed:
        if method != "componentDidUpdate":
            assert re.search(rf"^    {method}\(", classes[name], re.M), (name, method)
    for name in ("getData", "getInitToggleState", "toggleLabels"):
        assert name in classes["AbstractResults"]
    (icons,) = re.findall("NAMES = {(.*)}", script)
    for icon in re.findall(r'"?([\w-]+)"?: "', icons):
        assert f'"{icon}": [' in classes["Icon"]
