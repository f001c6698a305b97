#!/bin/sh
# Installs packages, builds tyndall-render, tyndall-viewer and the sample scenes, and renders the README's gallery into
# out/gallery.
set -eu
cd "$(dirname "$0")/.."
# shellcheck source=samples/setup.sh
. samples/setup.sh

# shellcheck disable=SC2086,SC2154 # lists of words, from setup.sh
install_packages $build_packages

say "Building into build/"
# A build of tests/run.sh keeps its tests; without one, what only tests need is not asked for.
cmake -S . -B build -G Ninja -DTYNDALL_BUILD_SAMPLES=ON
cmake --build build --target tyndall-render tyndall_scenes
viewer=
if cmake --build build --target help | grep -q '^tyndall-viewer:'; then
  cmake --build build --target tyndall-viewer
  viewer=" Play with them: build/bin/tyndall-viewer build/scenes/nave.glb"
fi

# picture SCENE [OPTION...]: 960x540 pixels, each the mean of 2x2. Fails where a scene lacks light, camera or medium.
picture() {
  scene=$1
  shift
  set -- build/bin/tyndall-render "build/scenes/$scene.glb" --size 960x540 --supersample 2 --strict "$@" \
    --out "out/gallery/$scene.png" --stats "out/gallery/$scene.json"
  echo "$*"
  "$@"
}

say "Rendering the gallery into out/gallery/"
mkdir -p out/gallery
picture nave-glass
picture nave
picture forest
picture terrain --cascades 4
picture cage --shadow-size 2048
picture stage
picture concert --shadow-size 2048
picture projector
picture orrery
picture pendulum --time 0.6
picture sweep --time 1
picture smoke
picture hair
picture censer
picture valley
picture harbour
say "Done: look at out/gallery/.$viewer"
