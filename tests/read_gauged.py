# SPDX-License-Identifier: BSD-3-Clause
"""Run by test_program: the reader on a scene that ended at its second gauge, which has no crater.   read_gauged.py PYTHON DIR"""
import os
import subprocess
import sys

package, directory = sys.argv[1:]
sys.path.insert(0, package)
import breech

run = breech.Run(directory)
assert run.scenes == ["scene"] and run.crater("scene") is None
assert breech.store(run.directory / "store")[0].crater is None
text = subprocess.run([sys.executable, "-m", "breech", directory], capture_output=True, text=True, check=True,
                      env={**os.environ, "PYTHONPATH": package}).stdout
assert "scene scene: until its second gauge" in text
