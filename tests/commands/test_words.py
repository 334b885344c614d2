"""What the command line says of wrong input, of help, to pipes and terminals."""

import json
import os
import pty
import subprocess
import sys

import pytest
import pyvista

from curvlib.commands.main import VERBS
from curvlib.meshes.torus import torus

PROGRAM = "import sys; from curvlib.commands.main import main; sys.exit(main())"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["estimate", "bal.ply"], "did you mean 'ball.ply'"),
        (["info", "bal.ply"], "did you mean 'ball.ply'"),
        (["estimate", "ball.ply", "-e", "mayer"], "did you mean 'meyer'"),
        (["estimate", "ball.ply", "-e", "meyer", "jet"], "write -e jet"),
        (["estimate", "ball.ply", "-e", "jet", "--set", "degre=3"], "did you mean 'degree'"),
        (["estimate", "ball.ply", "-e", "jet", "--rings", "9"], "unknown rings of jet '9'"),
        (["estimate", "ball.ply", "--radius", "wide"], "'wide' is no length"),
        (["estimate", "ball.ply", "-o", "out.docx"], "cannot tell the format"),
        (["estimate", "ball.ply", "-o", "ball.ply/out.vtp"], "ball.ply"),
        (["estimate", "ball.ply", "-o", "."], "is a folder"),
        (["estimate", "ball.ply", "-o", "./ball.ply"], "over the mesh itself"),
        (["estimate", "ball.ply", "ball.stl", "-o", "{stem}.ply"], "more than one mesh"),
        (["compare", "meyer", "--picture", "a.pdf"], "a picture is a .png file"),
        (["estimate", "ball.ply", "-o", "/proc/out.vtp"], "/proc/out.vtp"),
        (
            ["estimate", "ball.ply", "-e", "meyer", "--rings", "2"],
            "option of meyer 'rings'; valid: none",
        ),
        (["estimate", "ball.ply", "--picture", "a.jpg"], "a picture is a .png file"),
        (["estimate", "ball.ply", "-e", "meyer", "--per", "face"], "at vertices alone"),
        (["estimate", "broken.ply"], "cannot read it"),
        (["estimate", "words.txt"], "cannot tell its format"),
        (["estimate", "ball.ply", "-e", "fails.py"], "fails.py, line 2: KeyError"),
        (["estimate", "ball.ply", "-e", "numba.py"], "numba.py: NameError: name 'nothing'"),
        (["list", "mayer"], "did you mean 'meyer'"),
        (["mesh", "coen", "-n", "8", "-o", "a.vtp"], "did you mean 'cone'"),
        (["check", "none.py"], "does not exist"),
        (["compare", "mayer"], "did you mean 'meyer'"),
    ],
)
def test_an_error_is_one_line_and_leaves_nothing(ball, arguments, words, run, tmp_path):
    for name, text in (
        ("broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"),
        ("words.txt", "words"),
        ("fails.py", "def estimate(ring):\n    return {}['K'], None\n"),
        (
            "numba.py",
            "from curvlib.kit.compiled import compiled\n\n\n@compiled\ndef estimate(ring):\n"
            "    return nothing(ring), None\n",
        ),
    ):
        (tmp_path / name).write_text(text, encoding="utf-8")
    before = set(os.listdir())
    status, _, err = run(*arguments)
    assert status == 1
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert words in err
    assert set(os.listdir()) == before


@pytest.mark.parametrize(
    "arguments",
    [
        ["estimate"],
        ["estimate", "a.ply", "--per", "edge"],
        ["estimate", "a.ply", "--rings", "many"],
        ["mesh", "cone", "-o", "a.vtp"],
        ["info", "a.ply", "b.ply"],
    ],
)
def test_wrong_usage(arguments, run):
    status, _, err = run(*arguments)
    assert status == 2
    assert "Usage: curvlib" in err


@pytest.mark.parametrize("verb", VERBS)
def test_help_brings_nothing_heavy(verb):
    code = (
        "import sys; from curvlib.commands.main import main; main([sys.argv[1], '-h'])\n"
        "heavy = 'numpy numba scipy pandas matplotlib pyvista trimesh h5py'.split()\n"
        "print([m for m in heavy if m in sys.modules])"
    )
    command = [sys.executable, "-c", code, verb]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.startswith(f"Usage: curvlib {verb}")
    assert done.stdout.endswith("\n[]\n")


def test_a_pipe_that_closes_is_no_error_message(ball):
    code = f"{sys.executable} -c '{PROGRAM}' list jet"
    done = subprocess.run(
        ["bash", "-c", f"{code} | head -n 1"], capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith("jet is given: disk")
    assert done.stderr == ""


def test_progress_is_silent_where_stderr_is_no_terminal(ball):
    command = [sys.executable, "-c", PROGRAM, "estimate", "ball.ply", "ball.vtp", "-e", "meyer"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    assert done.stdout.count("quantiles over the area") == 2


def read_to_the_end(leader, follower):
    """What has been written to a pseudo-terminal, and "end"; it comes in pieces."""
    os.write(follower, b"end\n")
    told = b""
    while not told.endswith(b"end\r\n"):
        told += os.read(leader, 1000)
    return told.replace(b"\r\n", b"\n")


def test_compiling_is_told_once_on_a_terminal(ball, tmp_path):
    """By a pseudo-terminal; code that is kept is not compiled again."""
    leader, follower = pty.openpty()
    command = [sys.executable, "-c", PROGRAM, "estimate", "ball.ply", "-e", "meyer"]
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "kept")}
    told = []
    for _ in range(2):
        subprocess.run(command, env=environment, stderr=follower, check=True)
        told.append(read_to_the_end(leader, follower))
    assert told[0].count(b"compiling, once per machine and version\n") == 1
    assert b"compiling" not in told[1]


@pytest.mark.parametrize(
    ("words", "completions"),
    [
        ("curvlib est", ["plain,estimate"]),
        ("curvlib estimate -e taubin_", ["plain,taubin_a", "plain,taubin_b"]),
        ("curvlib estimate --quantity sh", ["plain,shape_index"]),
        ("curvlib estimate --columns p", ["plain,pycurv"]),
        ("curvlib estimate ba", ["file,ba"]),
        ("curvlib mesh con", ["plain,cone", "plain,cone_apex"]),
        ("curvlib list vt", ["plain,vtk_curvatures"]),
        ("curvlib info --j", ["plain,--json"]),
    ],
)
def test_completion(words, completions):
    environment = os.environ | {
        "_CURVLIB_COMPLETE": "bash_complete",
        "COMP_WORDS": words,
        "COMP_CWORD": str(len(words.split()) - 1),
    }
    command = [sys.executable, "-c", PROGRAM]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == completions


def test_exit_codes_are_told(run):
    _, out, _ = run("--help")
    assert "0 done; 1 an error, told in one line; 2 wrong usage; 130 interrupted" in out
    assert "bash_source" in out


def test_list_tells_of_surfaces_and_peers_too(run):
    assert "Frustum of a cone" in run("list", "cone")[1]
    assert json.loads(run("list", "cone", "--json")[1])["name"] == "cone"
    assert "vtk_curvatures is given: mesh" in run("list", "vtk_curvatures")[1]
    status, _, err = run("list", "coen")
    assert status == 1
    assert "unknown estimator, peer or surface 'coen'; did you mean 'cone'?" in err
    assert max(map(len, run("list")[1].splitlines())) <= 120


def test_progress_of_one_estimate_on_a_terminal(tmp_path):
    """Of the blocks of one estimate, after PATIENCE; the line is empty in the end."""
    path = tmp_path / "torus.ply"
    vertices, faces = torus(70, "regular")
    pyvista.PolyData.from_regular_faces(vertices, faces).save(path)
    leader, follower = pty.openpty()
    code = f"import curvlib.commands.terminal as t; t.PATIENCE = 0; {PROGRAM}"
    command = [sys.executable, "-c", code, "estimate", str(path), "-e", "quadric"]
    subprocess.run(command, stderr=follower, stdout=subprocess.DEVNULL, check=True)
    told = read_to_the_end(leader, follower)
    assert b"% quadric" in told
    assert told.endswith(b"\r\x1b[Kend\n")
