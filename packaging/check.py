"""Builds sdist and wheel, and tries the wheel in empty environments; tells what was done.

In the oldest and the newest Python that the metadata claim and this machine has, with the newest
dependencies, and in the oldest with the oldest that they allow.
"""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

ROOT = Path(__file__).parents[1]
MEGABYTES = 2
SMOKE = Path(__file__).with_name("smoke.py")


def run(*command, **more):
    """A command that has to succeed; its output."""
    done = subprocess.run(command, capture_output=True, text=True, **more)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout.strip()


def built(folder):
    """Build both into a folder and return their paths, sdist first."""
    run("uv", "build", "--quiet", "--no-build-isolation", "--python", sys.executable,
        "--out-dir", folder, ROOT)  # fmt: skip
    (sdist,), (wheel,) = Path(folder).glob("*.tar.gz"), Path(folder).glob("*.whl")
    return sdist, wheel


def contents(sdist, wheel):
    """Check what is in both: pure Python, licences, every file of the package, below the limit."""
    assert wheel.name.endswith("-py3-none-any.whl"), wheel.name
    inside = set(ZipFile(wheel).namelist())
    package = run("git", "ls-files", "curvlib", cwd=ROOT).splitlines()
    assert inside >= set(package), set(package) - inside
    licences = {path.name for path in ROOT.glob("LICENSE*")}
    assert licences == {Path(name).name for name in inside if "/licenses/" in name}
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert names >= {"pyproject.toml", "README.md", "requirements.lock", *package}
    for path in (sdist, wheel):
        size = path.stat().st_size
        assert size < MEGABYTES * 1e6, f"{path.name}: {size} bytes"
        print(f"{path.name}: {size / 1e6:.2f} MB")


def project():
    """What pyproject.toml says of the package."""
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def pythons():
    """The oldest and the newest Python that is claimed and here: version -> interpreter."""
    claimed = re.findall(r"Python :: (3\.\d+)", "\n".join(project()["classifiers"]))
    found = {version: python for version in claimed if (python := interpreter(version))}
    for version in sorted(set(claimed) - set(found)):
        print(f"Python {version}: claimed, not on this machine")
    return {version: found[version] for version in (min(found, key=minor), max(found, key=minor))}


def interpreter(version):
    """The path of a Python of this version that runs, or None; pyenv's need not be active."""
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    for path in (shutil.which(f"python{version}"), *pyenv.glob(f"{version}.*/bin/python")):
        if path and not subprocess.run([path, "-c", "import venv"], capture_output=True).returncode:
            return path
    return None


def minor(version):
    """The 11 of 3.11."""
    return int(version.split(".")[1])


def tried(wheel, python, lowest):
    """Install the wheel into an empty environment, and use it in an empty home folder."""
    with TemporaryDirectory() as folder:
        place = Path(folder)
        run("uv", "venv", "--quiet", "--seed", "--python", python, place / "venv")
        own = place / "venv/bin/python"
        # Bounds are sought for requirements that are named here, not for those of the wheel.
        oldest = ["--resolution", "lowest-direct", *project()["dependencies"]] if lowest else []
        run("uv", "pip", "install", "--quiet", "--python", own, *oldest, wheel)
        run(own, "-m", "pip", "check")
        (place / "work").mkdir()
        kept = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
        home = {"HOME": folder, "PATH": f"{place}/venv/bin:{os.environ['PATH']}"}
        run(own, SMOKE, cwd=place / "work", env=kept | home)
        names = "numpy", "scipy", "numba", "h5py"
        listed = run(own, "-m", "pip", "list", "--format", "freeze").splitlines()
        return ", ".join(line for line in listed if line.partition("==")[0] in names)


def main():
    """Build into dist/, and check."""
    sdist, wheel = built(ROOT / "dist")
    contents(sdist, wheel)
    for number, (version, python) in enumerate(pythons().items()):
        for lowest in (False, True) if number == 0 else (False,):
            print(f"Python {version}: passes with {tried(wheel, python, lowest)}", flush=True)


if __name__ == "__main__":
    main()
