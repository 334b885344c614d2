"""Broken files of every format: a mesh or one error, in a process that ends well, without noise."""

import subprocess
import sys
from collections import Counter
from pathlib import Path

import meshio
import nibabel
import numpy as np
import pytest
import pyvista
import trimesh

import curvlib
from curvlib.meshes.reading import SUFFIXES
from curvlib.meshes.torus import torus

VERTICES, FACES = torus(5, "irregular")
# Files of each format; fewer of those that are read in a process of their own.
COUNT, APART = 120, 6


def written(folder, suffix):
    """Whole files of a format, those of text and of bytes."""
    data, plain = pyvista.PolyData.from_regular_faces(VERTICES, FACES), True
    solid = trimesh.Trimesh(VERTICES, FACES, process=False)
    files = [folder / f"a{suffix}", folder / f"b{suffix}"]
    if suffix in (".ply", ".vtp", ".vtk"):
        for file, plain in zip(files, (True, False)):
            data.save(file, binary=plain)
    elif suffix == ".stl":
        solid.export(files[0])
        solid.export(files[1], file_type="stl_ascii")
    elif suffix == ".vtu":
        for file, plain in zip(files, (True, False)):
            data.cast_to_unstructured_grid().save(file, binary=plain)
    elif suffix == ".msh":
        for file, kind in zip(files, ("gmsh", "gmsh22")):
            meshio.Mesh(VERTICES, [("triangle", FACES)]).write(file, file_format=kind)
    elif suffix == ".gltf":
        exported = trimesh.exchange.gltf.export_gltf(solid.scene(), embed_buffers=True)
        files = files[:1]
        files[0].write_bytes(exported["model.gltf"])
    elif suffix == ".gii":
        arrays = [(VERTICES.astype("f4"), "POINTSET"), (FACES.astype("i4"), "TRIANGLE")]
        image = nibabel.gifti.GiftiImage(
            darrays=[
                nibabel.gifti.GiftiDataArray(x, intent=f"NIFTI_INTENT_{name}") for x, name in arrays
            ]
        )
        files = files[:1]
        nibabel.save(image, files[0])
    elif SUFFIXES[suffix] == "freesurfer":
        files = files[:1]
        nibabel.freesurfer.write_geometry(files[0], VERTICES, FACES)
    elif suffix == ".vtkhdf":
        files = files[:1]
        data.save(files[0])
    else:
        files = files[:1]
        solid.export(files[0])
    return files


# One of FreeSurfer's suffixes stands for all.
FORMATS = [x for x, reader in SUFFIXES.items() if reader != "freesurfer"] + [".white"]


@pytest.mark.parametrize("suffix", FORMATS)
def test_broken_files(tmp_path, suffix):
    files = written(tmp_path, suffix)
    count = APART if SUFFIXES[suffix] == "pyvista, apart" else COUNT
    call = [sys.executable, str(Path(__file__).with_name("broken.py")), str(tmp_path), "1"]
    run = subprocess.run(
        [*call, str(count), *map(str, files)], capture_output=True, text=True, timeout=300
    )
    last = run.stdout.splitlines()[-1:]
    assert run.returncode == 0, (last, run.stderr[-500:])
    assert run.stderr == ""
    fates = Counter(line.split()[-1] for line in run.stdout.splitlines())
    assert fates["mesh"] + fates["error"] == count
    assert fates["error"] > count / 4


def test_whole_files(tmp_path):
    """What is broken there is readable whole."""
    for suffix in FORMATS:
        for file in written(tmp_path, suffix):
            mesh = curvlib.read(file)
            assert len(mesh.faces) == len(FACES), file
            found = mesh.vertices[mesh.faces]
            np.testing.assert_allclose(found, VERTICES[FACES], atol=1e-6)
