"""A job fails in one line; its log has the rest."""

import pytest

from curvlib.catalogue import estimators
from curvlib.errors import InputError
from curvlib.study.job import logged


def run(tmp_path, work):
    """What the terminal and the log of a job show, and its exit code."""
    log = tmp_path / "logs/estimate/mine.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    code = 0
    try:
        with logged(log):
            work()
    except SystemExit as end:
        code = end.code
    return code, log


def fails(error):
    def work():
        raise error

    return work


@pytest.fixture
def terminal(capsys):
    return lambda: capsys.readouterr().err.splitlines()


def test_the_terminal_shows_the_jobs_name(tmp_path, terminal):
    code, log = run(tmp_path, lambda: print("details"))
    assert (code, terminal()) == (0, ["estimate mine"])
    assert log.read_text().startswith("details\nprocessor time: ")


def test_wrong_input_and_a_full_disk_are_one_line(tmp_path, terminal):
    for error in (InputError("no such mesh"), OSError(28, "No space left on device", "a.csv")):
        code, log = run(tmp_path, fails(error))
        assert (code, terminal()) == (1, ["estimate mine", f"error: {error}"])
        assert "Traceback" in log.read_text()


def test_a_fault_in_an_estimators_file_is_one_line(tmp_path, terminal):
    mine = tmp_path / "mine.py"
    mine.write_text("def estimate(ring):\n    first = 1\n    return first / 0\n")
    code, log = run(tmp_path, lambda: estimators.module(str(mine)).estimate(None))
    _, line = terminal()
    assert code == 1
    assert line == (
        f"error: estimator {mine}, line 3: ZeroDivisionError: division by zero (traceback: {log})"
    )
    assert "return first / 0" in log.read_text()


def test_an_estimators_file_that_exits(tmp_path, terminal):
    mine = tmp_path / "mine.py"
    mine.write_text("def estimate(ring):\n    raise SystemExit('bye')\n")
    code, log = run(tmp_path, lambda: estimators.module(str(mine)).estimate(None))
    assert (code, terminal()[1]) == (
        1,
        f"error: estimator {mine}, line 2: SystemExit: bye (traceback: {log})",
    )


def test_a_log_that_cannot_be_written_is_one_line(tmp_path, terminal):
    log = tmp_path / "logs/estimate/mine.log"
    log.parent.mkdir(parents=True)
    log.symlink_to("/dev/full")
    for work, line in ((lambda: None, []), (fails(InputError("no mesh")), ["error: no mesh"])):
        code, _ = run(tmp_path, work)
        assert (code, terminal()) == (
            1,
            ["estimate mine", *line, f"error: {log}: No space left on device"],
        )


def test_a_fault_of_ours_keeps_its_traceback(tmp_path, terminal):
    code, _ = run(tmp_path, fails(KeyError("ours")))
    shown = terminal()
    assert code == 1
    assert shown[1].startswith("Traceback")
    assert shown.count("KeyError: 'ours'") == 1
