# shellcheck shell=sh disable=SC2154 # sourced by gpu.sh
# The plots of a report.

# A python3 that has matplotlib, or nothing.
plotting_python() {
  for python in /usr/bin/python3 python3; do
    "$python" -c 'import matplotlib' 2>/dev/null && echo "$python" && return
  done
}

# draw_plots DIR: of its report.json, beside it.
draw_plots() {
  [ -f "$1/report.json" ] || stop "$1/report.json: is not there; --plots takes the folder of a report"
  python=$(plotting_python)
  [ -n "$python" ] || stop "--plots: python3 with matplotlib is needed (Debian's package python3-matplotlib)"
  timeout 120 "$python" "$here/gpu/plots.py" "$1"
}
