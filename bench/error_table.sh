#!/usr/bin/env bash
# The tables of docs/numerics.md: every scene in float by each variant of the kernels, then in double; what is spared.
# bench/error_table.sh [options of clucida-bench error], about 20 minutes on two cores. Build first (scripts/demo).
set -euo pipefail
cd "$(dirname "$0")/.."
float=$(build/clucida-bench error scenes/*.clu --variant full,reoriginated,naive --markdown "$@")
double=$(build/clucida-bench error scenes/*.clu --precision double --no-costs --markdown "$@")
sed '/^$/,$d' <<<"$float"
tail -n +3 <<<"$double"
sed -n '/^$/,$p' <<<"$float"
