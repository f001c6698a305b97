#include "TuningOptions.h"

#include "OptionRules.h"

namespace render {

namespace {

const Names<tyndall::Masking> kMaskings = {
    {"auto", tyndall::Masking::Auto}, {"stencil", tyndall::Masking::Stencil}, {"tiles", tyndall::Masking::Tiles}};
const Names<tyndall::Compositing> kCompositings = {{"auto", tyndall::Compositing::Auto},
                                                   {"dual-source", tyndall::Compositing::DualSource},
                                                   {"copy", tyndall::Compositing::Copy}};

} // namespace

void addTuning(CLI::App& app, tyndall::Tuning& tuning) {
  chooseFrom(kMaskings, app.add_option("--reuse-mask", tuning.reuse,
                                       "what keeps a frame to the pixels that have changed (default auto)"));
  chooseFrom(kMaskings, app.add_option("--fixup-mask", tuning.fixup,
                                       "what keeps the fix-up to the pixels that no sample serves (default auto)"));
  chooseFrom(kCompositings, app.add_option("--compositing", tuning.compositing,
                                           "how light is blended into the colour (default auto)"));
  app.add_option("--band-ms", tuning.bandMilliseconds,
                 "draw in bands what may take the GPU longer, at once, than so many milliseconds; 0: nothing (default "
                 "100, of a software rasteriser 0)")
      ->check(CLI::Range(0.0, 10000.0));
}

} // namespace render
