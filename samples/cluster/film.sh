#!/bin/sh
# The job after the array: makes the film of the frames if all are whole. submit.py submits it.
#   film.sh FOLDER FILM FIRST COUNT RESUBMIT COMMAND...
# FOLDER/FILM is written; RESUBMIT is the command that renders what is missing; COMMAND --missing names it.
set -u
folder=$1 film=$2 first=$3 count=$4 resubmit=$5
shift 5

fail() {
  echo "film: $folder: $*" >&2
  exit 1
}

# No task is left: what a killed one had not finished goes.
find "$folder/frames" -name '.tyndall-*.part' -exec rm -f {} +

missing=$("$@" --missing)
case $? in
  0) ;;
  1)
    [ -n "$missing" ] || fail "the frames cannot be checked, see above"
    echo "film: $folder: frames $missing are missing or not whole; why is in $folder/log" >&2
    echo "film: this renders them and no others: $resubmit" >&2
    exit 1
    ;;
  *) fail "the frames cannot be checked, see above" ;;
esac

command -v ffmpeg >/dev/null || fail "all frames are there, but no ffmpeg to make $film: install it, then $resubmit"
case $film in
  *.mp4) encoding="-pix_fmt yuv420p -c:v libx264 -crf 18 -movflags +faststart" ;;
  *) encoding="-pix_fmt yuv420p -c:v libvpx-vp9 -crf 24 -b:v 0" ;;
esac
unfinished=$folder/.unfinished-$film
trap 'rm -f "$unfinished"' EXIT
trap 'exit 143' HUP INT TERM
# Chroma at half the size needs even sides.
# shellcheck disable=SC2086 # a list of words
ffmpeg -nostdin -loglevel error -y -framerate 24 -start_number "$first" -i "$folder/frames/%04d.png" \
  -frames:v "$count" -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' $encoding "$unfinished" || fail "ffmpeg failed, see above"
mv -f "$unfinished" "$folder/$film" || fail "$film cannot be written"
echo "film: $folder/$film: $count frames"
