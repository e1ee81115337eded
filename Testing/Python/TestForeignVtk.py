# SPDX-License-Identifier: BSD-3-Clause
"""import tipp with another VTK than the one that tipp was built with."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

from vtkmodules.vtkCommonCore import vtkVersion


def import_tipp(modules):
    """The output of `import tipp` in a Python that finds these modules first."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in modules.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
        code = f"import sys; sys.path.insert(0, {folder!r}); import tipp"
        return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)


class ForeignVtk(unittest.TestCase):
    def test_another_release_is_an_import_error_with_both_versions(self):
        version = "class vtkVersion:\n    GetVTKVersion = staticmethod(lambda: '9.99.1')\n"
        run = import_tipp({"vtkmodules/__init__.py": "", "vtkmodules/vtkCommonCore.py": version})
        self.assertEqual(1, run.returncode, run.stderr)
        last = run.stderr.splitlines()[-1]
        self.assertRegex(last, "^ImportError: tipp was built with VTK 9[.][0-9.]+ and cannot be used beside VTK 9[.]99[.]1")
        self.assertIn(vtkVersion.GetVTKVersion(), last)

    def test_no_vtk_is_an_import_error_with_the_version_wanted(self):
        run = import_tipp({"vtkmodules/__init__.py": ""})
        self.assertEqual(1, run.returncode, run.stderr)
        self.assertRegex(run.stderr.splitlines()[-1], "^ImportError: tipp needs the Python modules of VTK 9[.]")

    def test_the_same_vtk_is_accepted(self):
        self.assertEqual(0, import_tipp({}).returncode)


if __name__ == "__main__":
    unittest.main()
