#!/bin/sh
# Films the README's ten seconds of tyndall-viewer into out/gallery/viewer.webp, and its picture into viewer.png, on an X
# server of its own: a light is dragged, the view turned, the air made thicker, two techniques compared. Needs
# tyndall-viewer and the sample scenes (samples/run.sh).
set -eu
cd "$(dirname "$0")/../.."
# shellcheck source=samples/setup.sh
. samples/setup.sh
if [ -z "${DISPLAY_OF_ITS_OWN:-}" ]; then
  install_packages ffmpeg webp xvfb xauth xdotool
  DISPLAY_OF_ITS_OWN=1 exec xvfb-run -a -s "-screen 0 1280x720x24" sh samples/gallery/viewer.sh
fi

work=out/gallery/viewer
rm -rf "$work"
mkdir -p "$work"
cat >"$work/start.json" <<'END'
{"version": 1, "scene": "../../../build/scenes/stage.glb", "profile": "balanced", "maps": {"shadowSize": 1024}}
END
XDG_CONFIG_HOME="$work" build/bin/tyndall-viewer "$work/start.json" &
viewer=$!
trap 'kill $viewer' EXIT
window=$(xdotool search --sync --onlyvisible --name '^Tyndall viewer$' | head -1)
xdotool windowfocus "$window" mousemove 640 300

# glide X Y: the mouse, in steps that a hand would make.
glide() {
  eval "$(xdotool getmouselocation --shell)" # X and Y
  for step in 1 2 3 4 5 6 7 8 9 10; do
    xdotool mousemove $((X + ($1 - X) * step / 10)) $((Y + ($2 - Y) * step / 10))
    sleep 0.07
  done
}
# drag X Y [BUTTON]: from where it is.
drag() {
  xdotool mousedown "${3:-1}"
  glide "$1" "$2"
  xdotool mouseup "${3:-1}"
}

sleep 15 # loaded, whole and measured
ffmpeg -v error -y -f x11grab -framerate 10 -video_size 1280x720 -i "$DISPLAY" -frames:v 1 "$work/still.png"
ffmpeg -v error -y -f x11grab -framerate 10 -video_size 1280x720 -i "$DISPLAY" -t 10 "$work/frame-%04d.png" &
film=$!
glide 608 230
drag 690 200
sleep 0.5
glide 900 560
drag 868 552
glide 129 18
xdotool click 1
glide 253 62
drag 238 62
sleep 0.3
glide 298 18
xdotool click 1
glide 17 41
xdotool click 1
sleep 0.5
glide 830 620
drag 560 620
wait $film
mv "$work/still.png" out/gallery/viewer.png
img2webp -loop 0 -kmin 3 -kmax 5 -lossy -q 60 -m 4 -d 100 "$work"/frame-*.png -o out/gallery/viewer.webp
ls -l out/gallery/viewer.webp
say "Done: look at out/gallery/viewer.png and viewer.webp"
