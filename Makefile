# Two commands: `make` reproduces the whole study, `make test` runs the tests.
# Both first build .venv from the hash-pinned requirements.lock. `make peers` adds the libraries
# behind curvlib/peers to it, `make test-peers` tests what these return. `make wheel` builds sdist
# and wheel into dist/ and tries the wheel in empty environments. `make docs` makes the documentation,
# docs/_build/html/index.html.

SHELL := /bin/sh
PYTHON ?= python3
export PATH := $(CURDIR)/.venv/bin:$(PATH)

# Snakemake and compiled code keep files in the home folder; without one, here.
ifneq ($(shell mkdir -p "$$HOME/.cache" 2>/dev/null && echo yes),yes)
export XDG_CACHE_HOME ?= $(CURDIR)/.venv/cache
endif

.PHONY: study test peers test-peers fuzz wheel docs lint lock clean

study: .venv/ready
	snakemake

test: .venv/ready lint
	pytest

peers: .venv/peers

test-peers: .venv/peers
	pytest tests/peers tests/dataset/test_readers.py

# Thousands of meshes with faults at random, others at each run.
fuzz: .venv/ready
	CURVLIB_EXAMPLES=3000 pytest tests/estimators/test_fuzz.py

# -W: a name or a page that does not exist ends it.
docs: .venv/docs
	sphinx-build -q -W --keep-going docs docs/_build/html

# It asks the package index for what the wheel needs, newest and oldest.
wheel: .venv/ready
	python packaging/check.py

lint: .venv/ready
	ruff check .
	ruff format --check .
	snakefmt --check Snakefile workflow
	snakemake --lint

# --compile-bytecode: the study starts many short processes, and each would
# otherwise compile what it imports where the environment forbids .pyc files.
# The last command has Numba compile the estimators, which it keeps for all of them.
.venv/ready: requirements.lock pyproject.toml
	$(PYTHON) -m venv .venv
	awk '/^uv==/ {on = 1; print; next} /^[^ ]/ {on = 0} on' requirements.lock > .venv/uv.txt
	pip install --quiet --disable-pip-version-check --require-hashes -r .venv/uv.txt
	uv pip sync --quiet --python .venv --require-hashes --compile-bytecode requirements.lock
	uv pip install --quiet --python .venv --no-deps --no-build-isolation --editable .
	python -c "import curvlib as c; c.estimate(c.tessellate(c.surface('sphere'), 8), c.estimators())"
	touch .venv/ready

.venv/peers: .venv/ready requirements-peers.lock
	uv pip install --quiet --python .venv --require-hashes --compile-bytecode \
		-r requirements-peers.lock
	touch .venv/peers

.venv/docs: .venv/ready requirements-docs.lock
	uv pip install --quiet --python .venv --require-hashes --compile-bytecode \
		-r requirements-docs.lock
	touch .venv/docs

# Rewrites the lock files after a change of the dependencies in pyproject.toml. The second and third
# hold the packages of the first, too: what is installed on top has to agree with them.
COMPILE := uv pip compile --quiet --universal --generate-hashes --no-header --no-annotate \
	--python-version 3.11 pyproject.toml
EXTRAS := --extra dataset --extra files --extra study --extra test --extra build
lock: .venv/ready
	$(COMPILE) $(EXTRAS) --output-file requirements.lock
	$(COMPILE) $(EXTRAS) --extra peers --extra libraries --output-file requirements-peers.lock
	$(COMPILE) $(EXTRAS) --extra docs --output-file requirements-docs.lock

clean:
	find results data -mindepth 1 ! -name README.md -delete
	rm -rf docs/_build docs/generated docs/examples dist
	rm -rf .snakemake
