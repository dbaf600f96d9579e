"""The picture: that of `clsurf render`, with and without VTK in the same process."""

import subprocess
import sys

import pytest

import clsurf
from conftest import PROGRAM, files


@pytest.mark.parametrize("field", ["speed", "speed_mismatch", "cause"])
def test_the_picture_is_that_of_render(uneven, uneven_files, tmp_path, field):
    ours, theirs = tmp_path / "ours.png", tmp_path / "theirs.png"
    uneven.picture(field, "top", size=(800, 600)).save(ours)
    subprocess.run(
        [PROGRAM, "render", *uneven_files, "-o", theirs, "--color", field, "--view", "top", "--size", "800x600", "--gl", "egl", "-q"],
        check=True,
    )
    compared = subprocess.run([PROGRAM, "compare", ours, theirs], capture_output=True, text=True)
    assert compared.returncode == 0, compared.stdout


def test_a_notebook_shows_it(uneven):
    picture = uneven.picture(size=(320, 240))
    assert picture._repr_png_()[:8] == b"\x89PNG\r\n\x1a\n"
    assert repr(picture) == "<clsurf.Picture: 320 × 240 pixels>"
    assert picture.png == uneven.picture(size=(320, 240)).png


def test_names_of_values_have_colours(uneven):
    assert uneven.picture("line", size=(320, 240)).png != uneven.picture("speed", size=(320, 240)).png


@pytest.mark.parametrize("order", ["clsurf, vtkmodules.vtkRenderingOpenGL2", "vtkmodules.vtkRenderingOpenGL2, clsurf"])
def test_vtk_of_the_interpreter_does_no_harm(uneven, order, tmp_path):
    pytest.importorskip("vtkmodules.vtkRenderingOpenGL2")
    path = tmp_path / "picture.png"
    program, log = files("bottle_uneven.nc")
    script = f"import {order}\nclsurf.Part({program!r}, {log!r}, tool='ball:6').picture(size=(320, 240)).save({str(path)!r})"
    subprocess.run([sys.executable, "-c", script], check=True)
    assert path.read_bytes() == uneven.picture(size=(320, 240)).png


def test_pandas_and_vtk_are_loaded_when_they_are_needed():
    script = "import sys, clsurf; sys.exit('pandas' in sys.modules or any(name.startswith('vtk') for name in sys.modules))"
    subprocess.run([sys.executable, "-c", script], check=True)
