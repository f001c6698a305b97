#!/bin/sh
# run.sh WINE XVFB_RUN FOLDER: FOLDER/consumer.exe in Wine, on a screen of its own. 77: skipped.
set -eu
[ -x "$1" ] || { echo "skipped: wine is not installed"; exit 77; }
[ -x "$2" ] || { echo "skipped: xvfb is not installed"; exit 77; }
[ -x "$3/consumer.exe" ] || { echo "skipped: windows.compile has built no consumer.exe"; exit 77; }
WINEPREFIX=$3/wine WINEARCH=win64 WINEDEBUG=-all "$2" -a "$1" "$3/consumer.exe"
