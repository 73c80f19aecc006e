# SPDX-License-Identifier: BSD-3-Clause
"""The crater of one impact on the bare rail and on a coated one, with coarse cells: a try of seconds."""
import breech

case = breech.Case("cases/default_shot")
case["scene.velocity"] = "1.5 km/s"
case["scene.cells_per_radius"] = 1.5  # three and more for numbers to be believed
case["scene.damage"] = False          # nickel has no constants of failure
case["output.snapshots"] = 0

for name, layers in (("bare", []), ("nickel", [{"material": "nickel", "thickness": "0.5 mm"}])):
    case["rail.layers"] = layers
    run = case.run("scene", f"out/coated/{name}", force=True, progress=False)
    crater = run.crater("scene")
    length, width, depth = (1e3 * crater.numbers[key] for key in ("length_m", "width_m", "depth_m"))
    print(f"{name:6}  {crater.texts['class']:9}  {length:.2f} x {width:.2f} mm, {depth:.3f} mm deep, "
          f"{1e9 * crater.numbers['volume_m3']:.2f} mm3, rim {1e3 * crater.numbers['rim_height_m']:.3f} mm")
    breech.plot.crater(crater).savefig(f"out/coated/{name}.png")
