#!/usr/bin/env bash
# Do craters hang on how cells are chosen?  The default shot's scene on three grids each, shifted against one another by
# parts of a cell: as it is, and with one choice changed at a time.  Prints the table of docs/scene-solver.md, "Levels";
# some ten minutes on two cores.
#   tests/validate/levels.sh BREECH OUT
set -euo pipefail
breech=$(realpath "$1") out=$2
case=$(realpath "$(dirname "$0")/../../cases/default_shot")
mkdir -p "$out"
common=(--ensemble 3 --quiet --set "scene.contact_pressure=60 MPa" --set "scene.end_time=8 us"
    --set scene.cells_per_radius=2)

row() # name, velocity [m/s], settings
{
    local name=$1 velocity=$2
    shift 2
    local folder="$out/${name// /_}_$velocity"
    "$breech" scene "$case" "${common[@]}" --set "scene.velocity=$velocity m/s" "$@" -o "$folder" --force --store "$out/store" \
        >"$folder.txt" 2>&1 || { cat "$folder.txt" && exit 1; }
    python3 - "$folder/summary.json" "$name" "$velocity" <<'P'
import json, sys
summary = json.load(open(sys.argv[1]))
number = summary["numbers"]
def of(name, unit, digits):
    n = number[name]
    return f"{n['mean'] / unit:.{digits}f} ± {n['deviation'] / unit:.{digits}f}"
print("| " + " | ".join([sys.argv[3], sys.argv[2], of("crater_volume", 1e-9, 2), of("crater_length", 1e-3, 2),
      of("crater_width", 1e-3, 2), of("crater_depth", 1e-3, 3)]) + " |")
P
}

echo "| m/s | what is changed | volume [mm3] | length [mm] | width [mm] | depth [mm] |"
echo "|---|---|---|---|---|---|"
for velocity in 1000 1300 1600; do
    row "nothing" $velocity
    row "half the tolerance" $velocity --set scene.refine_tolerance=0.05
    row "twice the tolerance" $velocity --set scene.refine_tolerance=0.2
    row "two levels" $velocity --set scene.levels=2
    row "a window half as large again" $velocity --set "scene.rail_ahead=21 mm" --set "scene.rail_behind=15 mm" \
        --set "scene.rail_depth=12 mm"
done
