#!/usr/bin/env bash
# Converts the gallery's data and draws its pictures: draw.sh [ELVIS [FOLDER]]
#   ELVIS   the program, by default build/release/bin/elvis
#   FOLDER  where volumes and pictures go, by default beside the scenes
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
data=$(dirname "$here")
elvis=$(realpath "${1:-$data/../../build/release/bin/elvis}")
folder=$(realpath "${2:-$here}")

convert() { # arguments: name, data files
    "$elvis" --quiet convert "${@:2}" -o "$folder/$1.h5"
}
convert canister "$data/elvis/bulletH1P2.dat"
convert fichera "$data"/mfem/poisson-fichera-q3-p5/{mesh.mesh,sol.gf}
convert mixed "$data"/nektarpp/cA.{xml,fld}
convert jumps "$data"/mfem/dg-fichera-q3-p4/{mesh.mesh,sol.gf}
convert beam "$data"/mfem/elast-beam-hex-p4/{mesh.mesh,sol.gf}
convert streaks "$data"/mfem/maxwell-fichera-q3-nd3/{mesh.mesh,sol.gf}
convert sinc "$data/elvis/raySincBox_F4_P4.dat"

for scene in "$here"/*.json; do
    name=$(basename "$scene" .json)
    # Scenes name the volumes beside them.
    [ "$folder" = "$here" ] || cp "$scene" "$folder"
    "$elvis" render "$folder/$name.json" -o "$folder/$name.png"
done
