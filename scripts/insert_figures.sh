#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Replaces what stands between the marks `<!-- figures: begin` and `<!-- figures: end` of a page by a file.
#   scripts/insert_figures.sh docs/performance.md out/benchmark/performance.md
# With a name, between the marks `<!-- figures: begin NAME` and the end that follows.
#   scripts/insert_figures.sh docs/reproduction.md out/vi-c/vi_c.md vi-c
set -euo pipefail
page=$1 figures=$2 mark="<!-- figures: begin ${3:+$3 }("
changed=$(mktemp)
trap 'rm -f "$changed"' EXIT
awk -v figures="$figures" -v mark="$mark" '
  index($0, mark) { print; while ((getline line < figures) > 0) print line; inside = 1; next }
  /<!-- figures: end/ { inside = 0 }
  !inside { print }
' "$page" >"$changed"
cat "$changed" >"$page"
