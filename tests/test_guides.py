"""The guides: their Python runs as it stands."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


PAGES = [*ROOT.glob("docs/*.md"), *ROOT.glob("docs/[!_g]*/*.md")]
DOCS = sorted(path.relative_to(ROOT).as_posix() for path in PAGES)


@pytest.mark.parametrize("guides", [["README.md"], ["CONTRIBUTING.md"], DOCS])
def test_python_in_the_guides(guides, tmp_path):
    """Blocks run one after the other; one that begins with `# name.py` is that file."""
    text = "\n".join((ROOT / guide).read_text(encoding="utf-8") for guide in guides)
    blocks = re.findall(r"```python\n(.*?)```", text, re.S)
    assert blocks
    code = []
    for block in blocks:
        name = re.match(r"# (\w+\.py)\n", block)
        if name:
            (tmp_path / name[1]).write_text(block, encoding="utf-8")
        else:
            code.append(block)
    command = [sys.executable, "-W", "error", "-c", "\n".join(code)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
