# SPDX-License-Identifier: BSD-3-Clause
"""Ranks five coatings of the default shot's rails by the gouges that a shot makes."""
import breech

case = breech.Case("cases/default_shot")
case["name"] = "coatings"
case["sites"] = None  # grains strewn at random, in place of twelve at given places
case["populations"] = [{"density": "4 1/m", "shape": "hemisphere", "sizes": [{"radius": "0.5 mm", "share": 1}]}]
case["treatments"] = [{"name": metal, "coating": [{"material": metal, "thickness": "0.5 mm"}]}
                      for metal in ("steel_4340", "ti6al4v", "nickel", "tantalum", "w_alloy")]
case["scene.damage"] = False  # three of these metals have no constants of failure
case["study.craters"] = 0     # thresholds and numbers of gouges alone
run = case.run("compare", "out/coatings", force=True)

for one in run.summary["ranking"]:  # fewest gouges first
    low, high, gouges = ("-" if v is None else f"{v:.4g}" for v in (*(one["threshold_interval"] or [None] * 2), one["gouges"]))
    told = "" if one["tied"] > 1 else "best, or cannot be told from it"
    print(f"{one['surface']:12}  gouges from {low} .. {high} m/s  {gouges} a shot  {told}")
print(run.summary["verdict"])
breech.plot.threshold(run).savefig("out/coatings/ranking.png")
