#!/bin/sh
# Renders the two animations of the README into out/gallery/: beams of stage lights that sweep, and a pendulum with what each
# frame draws anew beside it. Minutes on two cores. Needs tyndall-render and the sample scenes (samples/run.sh).
set -eu
cd "$(dirname "$0")/../.."
# shellcheck source=samples/setup.sh
. samples/setup.sh
install_packages ffmpeg webp

frames=out/gallery/frames
rm -rf "$frames"
mkdir -p "$frames"

# render NAME FIRST-LAST SCENE [OPTION...]: frames of an animation, each pixel the mean of 2x2.
render() {
  name=$1 range=$2 scene=$3
  shift 3
  set -- build/bin/tyndall-render "build/scenes/$scene.glb" --frames "$range" --supersample 2 --strict "$@" \
    --out "$frames/$name-%04d.png"
  echo "$*"
  "$@"
}

# film NAME QUALITY: its frames as an animated WebP that loops, 24 a second. All are key frames: what is kept from frame to
# frame shows as blocks in fog.
film() {
  img2webp -loop 0 -kmin 0 -kmax 1 -lossy -q "$2" -m 4 -d 42 "$frames/$1"-*.png -o "out/gallery/$1.webp"
  ls -l "out/gallery/$1.webp"
}

say "Stage lights"
render sweep 0-119 sweep --size 640x360 --shadow-size 2048
film sweep 75

# The first frame draws all: the loop, a swing to and fro, is the 150 after it. What is not drawn anew is dimmed.
say "Pendulum"
render picture 0-150 pendulum --size 480x270
render redrawn 0-150 pendulum --size 480x270 --view redrawn
ffmpeg -v error -y -start_number 1 -i "$frames/picture-%04d.png" -start_number 1 -i "$frames/redrawn-%04d.png" \
  -filter_complex "[0]format=gbrp,split[picture][below];[below]colorlevels=romax=.35:gomax=.35:bomax=.35[dimmed];
    [1]format=gbrp,colorlevels=romax=.65:gomax=.16:bomax=.06[redrawn];[dimmed][redrawn]blend=all_mode=addition[mask];
    [picture][mask]hstack" "$frames/pendulum-%04d.png"
film pendulum 70
say "Done: look at out/gallery/sweep.webp and pendulum.webp"
