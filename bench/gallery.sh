#!/usr/bin/env bash
# Renders the pictures of docs/gallery: bench/gallery.sh PROGRAM
set -euo pipefail
cd "$(dirname "$0")/.."
"$1" render scenes/cluster.clu -s 1280x720 --samples 8 --quality 88 -o docs/gallery/cluster.jpg
for name in drink gems globes bricks; do
    "$1" render "scenes/$name.clu" -s 960x540 --samples 4 --quality 85 -o "docs/gallery/$name.jpg"
done
