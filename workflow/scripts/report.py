"""Let Snakemake write its report of the same study."""

import json
import subprocess
import sys
import tempfile

from curvlib.study.job import logged

with (
    logged(snakemake.log[0]),
    tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as config,
):
    json.dump(snakemake.params.config, config)
    config.flush()
    command = [sys.executable, "-m", "snakemake", "all", "--report", snakemake.output[0]]
    # The run that asks for the report holds the folder's lock.
    command += ["--nolock", "--snakefile", snakemake.params.snakefile, "--configfile", config.name]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    print(done.stdout, done.stderr)
    if done.returncode:
        raise RuntimeError(done.stderr)
