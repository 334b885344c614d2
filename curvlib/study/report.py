"""What the report adds to Snakemake's own: its answer, pages for its tables, captions in view."""

import base64
import csv
import gzip
import html
import json
import re
from pathlib import Path

from curvlib.files import whole_file


def answer(markdown: str) -> str:
    """HTML of the answer, whose tables scroll on narrow screens."""
    from markdown_it import MarkdownIt

    text = MarkdownIt("js-default").render(markdown.replace("^2", "²"))
    text = text.replace("<table>", '<div class="wide" tabindex="0"><table>')
    return text.replace("</table>", "</table></div>")


def page(template: str, table, caption, names: dict, sentences: dict) -> str:
    """A page that shows a table, to be searched, filtered and sorted without a network.

    `table`: a CSV file. `caption`: its title and text. A cell that is one of `names` is shown in
    its words; `sentences` are the words of the column `claim`.
    """
    with Path(table).open(newline="", encoding="utf-8") as file:
        columns, *rows = csv.reader(file)
    shown = {"columns": columns, "rows": rows, "names": names, "sentences": sentences}
    packed = gzip.compress(json.dumps(shown, ensure_ascii=False).encode(), mtime=0)
    values = {
        "TITLE": html.escape(caption.title),
        "CAPTION": html.escape(caption.text),
        "FILE": html.escape(Path(table).name),
        "DATA": base64.b64encode(packed).decode(),
    }
    return re.sub("{{(" + "|".join(values) + ")}}", lambda found: values[found[1]], template)


def sentences(summary) -> dict[str, str]:
    """The number of each claim -> the claim in words, from claims-summary.csv."""
    with Path(summary).open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {row["claim"]: f"{row['claim']}. {row['sentence']}".replace("^2", "²") for row in rows}


def add_script(report, script) -> None:
    """Put a script at the end of a report that Snakemake has written."""
    path, code = Path(report), Path(script).read_text(encoding="utf-8")
    text, end, rest = path.read_text(encoding="utf-8").rpartition("</body>")
    with whole_file(path) as part:
        part.write_text(f"{text}<script>\n{code}</script>\n{end}{rest}", encoding="utf-8")
