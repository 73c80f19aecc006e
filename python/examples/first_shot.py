# SPDX-License-Identifier: BSD-3-Clause
"""A shot, the same at other charges, and one impact, cell by cell."""
# %% A case is nested dicts; a quantity keeps the unit that it has in the file
import breech

case = breech.Case("cases/default_shot")
print(case["bank"]["charge"], case["barrel.length"], case["sites[0].position"].value)

# %% A run writes a directory; series are numpy arrays in SI units
run = case.run("shot", "out/python/shot", force=True)
shot = run.shot
print(f"{run.summary['muzzle_velocity']:.0f} m/s after {1e3 * run.summary['muzzle_time']:.2f} ms")
fastest = shot["acceleration"].argmax()
print(f"{shot['acceleration'][fastest]:.3g} {shot.units['acceleration']} at {shot['position'][fastest]:.2f} m")
breech.plot.shot(run).savefig("out/python/shot.png")

# %% Change what you like: here the charge, as a part of what the file says
for part in (0.8, 0.9, 1.0):
    weaker = case.copy()
    weaker["bank.charge"] = part * case["bank.charge"]
    summary = weaker.run("shot", f"out/python/charge-{part}", force=True, progress=False).summary
    print(f"{weaker['bank.charge']}: {summary['muzzle_velocity']:.0f} m/s, efficiency {summary['efficiency']:.3f}")

# %% One impact at 1.2 km/s, and the crater that it leaves
case["scene.velocity"] = "1.2 km/s"
run = case.run("scene", "out/python/impact", force=True)
crater = run.crater("scene")
print(f"{run.summary['class']}: {1e3 * crater.depth.max():.2f} mm deep, on {crater.depth.shape} points of a map")
breech.plot.crater(crater).savefig("out/python/crater.png")

# %% What is wrong is said in the program's words
case["scene.velocity"] = "1.2 kg"
try:
    case.check()
except breech.BadInput as error:
    print(error)
