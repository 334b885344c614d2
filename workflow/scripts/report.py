"""Let Snakemake write its report of the same study, and add what it lacks."""

import json
import subprocess
import sys
import tempfile

from curvlib.study.job import logged
from curvlib.study.report import add_script

with (
    logged(snakemake.log[0]),
    tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as config,
):
    params, output = snakemake.params, snakemake.output[0]
    json.dump(params.config, config)
    config.flush()
    command = [sys.executable, "-m", "snakemake", "all", "table_pages", "--report", output]
    command += ["--report-stylesheet", params.style]
    # The run that asks for the report holds the folder's lock.
    command += ["--nolock", "--snakefile", params.snakefile, "--configfile", config.name]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    print(done.stdout, done.stderr)
    if done.returncode:
        raise RuntimeError(done.stderr)
    add_script(output, params.behaviour)
