#!/usr/bin/env bash
# Time to a 640x360 picture with a cold and with a warm kernel cache: bench/first_light.sh PROGRAM [SCENE...]
# Prints the table of docs/performance.md: the cold run once, the warm run as the median of five, and beside them how far
# the float picture is from that of the double kernel (linear light).
set -euo pipefail
program=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export POCL_CACHE_DIR=$folder/pocl XDG_CACHE_HOME=$folder/cache
mkdir -p "$POCL_CACHE_DIR" "$XDG_CACHE_HOME"

run() {
    "$program" render "$1" -s 640x360 -o "$folder/picture.png" --json -q 2>/dev/null | python3 -c '
import json, sys
r = json.load(sys.stdin)
s = r["seconds"]
print(*("%.2f" % v for v in (s["total"], s["build"], s["first_launch"], s["trace"])), "%.2f" % (r["rays_per_second"] / 1e6), r["statistics"]["parity"])'
}

apart() {
    "$program" render "$1" -s 640x360 -o "$folder/float.pfm" -q 2>/dev/null
    "$program" render "$1" -s 640x360 -o "$folder/double.pfm" -q --precision double 2>/dev/null
    "$program" compare "$folder/float.pfm" "$folder/double.pfm" --json | python3 -c '
import json, sys
r = json.load(sys.stdin)
print("%.1e" % r["rmse"], "%.1f" % (1e6 * r["over_fraction"]))'
}

echo "| scene | cold: total, s | build | first launch | warm: total, s | trace | million rays/s | parity faults | RMSE to double | pixels off by > 1/255, ppm |"
echo "|---|---|---|---|---|---|---|---|---|---|"
for scene in "$@"; do
    read -r total build launch _ _ _ < <(run "$scene")
    read -r warm _ _ trace rays parity < <(for _ in 1 2 3 4 5; do run "$scene"; done | sort -n | sed -n 3p)
    read -r rmse off < <(apart "$scene")
    echo "| $(basename "$scene") | $total | $build | $launch | $warm | $trace | $rays | $parity | $rmse | $off |"
done
