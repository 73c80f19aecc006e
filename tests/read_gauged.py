"""Run by test_program: the reader on a scene that ended at its second gauge, which has no crater.   read_gauged.py TOOLS DIR"""
import subprocess
import sys

tools, directory = sys.argv[1:]
sys.path.insert(0, tools)
import breech

run = breech.Run(directory)
assert run.scenes == ["scene"] and run.crater("scene") is None
assert breech.store(run.directory / "store")[0].crater is None
text = subprocess.run([sys.executable, f"{tools}/breech.py", directory], capture_output=True, text=True, check=True).stdout
assert "scene scene: until its second gauge" in text
