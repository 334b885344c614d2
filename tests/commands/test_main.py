"""The command line: what it prints, and its exit status."""

import subprocess
import sys

import pytest

import curvlib
from curvlib.commands.main import main


def test_version_and_verbs(capsys):
    for arguments, said in ((["--version"], f"curvlib {curvlib.__version__}\n"), (["-h"], "fetch")):
        assert main(arguments) == 0
        assert said in capsys.readouterr().out


@pytest.mark.parametrize("arguments", [[], ["fecth"], ["fetch", "a.zip", "--outptu", "b"]])
def test_wrong_usage(arguments, capsys):
    assert main(arguments) == 2
    assert "Usage: curvlib" in capsys.readouterr().err


def test_bad_input_is_one_line(capsys):
    assert main(["fetch", "nothing.txt"]) == 1
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("error: nothing.txt: not an archive")
    assert captured.err.count("\n") == 1


def test_an_interruption_is_one_line_without_a_traceback():
    """As in a shell, where Ctrl-C gives status 128 + SIGINT; first the line with ^C ends."""
    code = (
        "import os, signal, sys\n"
        # A shell's background job inherits that it is ignored.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "import curvlib.dataset.fetch as verb\n"
        "from curvlib.commands.main import main\n"
        "verb.fetch = lambda *_: os.kill(os.getpid(), signal.SIGINT)\n"
        "sys.exit(main(['fetch', 'a.zip']))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "\ninterrupted\n")
