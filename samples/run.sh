#!/bin/sh
# Installs packages, builds tyndall-render and the sample scenes, and renders the gallery into out/gallery.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

install_packages $build_packages

say "Building into build/"
cmake -S . -B build -G Ninja -DTYNDALL_BUILD_TESTS=OFF
cmake --build build

say "Rendering the gallery into out/gallery/"
mkdir -p out/gallery
for scene in nave nave-glass forest terrain cage stage; do
  build/bin/tyndall-render "build/scenes/$scene.glb" --size 1280x720 --shadow-size 4096 --context osmesa \
    --out "out/gallery/$scene.png" --out "out/gallery/$scene.exr" --stats "out/gallery/$scene.json"
  echo "out/gallery/$scene.png"
done
say "Done: look at out/gallery/"
