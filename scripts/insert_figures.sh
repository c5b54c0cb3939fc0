#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Replaces what stands between the marks `<!-- figures: begin` and `<!-- figures: end` of a page by a file.
#   scripts/insert_figures.sh docs/performance.md out/benchmark/performance.md
set -euo pipefail
page=$1 figures=$2
changed=$(mktemp)
trap 'rm -f "$changed"' EXIT
awk -v figures="$figures" '
  /<!-- figures: begin/ { print; while ((getline line < figures) > 0) print line; inside = 1; next }
  /<!-- figures: end/ { inside = 0 }
  !inside { print }
' "$page" >"$changed"
cat "$changed" >"$page"
