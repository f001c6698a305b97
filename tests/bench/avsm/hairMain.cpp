// tyndall-hair-bench: how far the light that maps of curves let through to strands is from what comes there by
// geometry.
#include "Hair.h"

#include <algorithm>
#include <fmt/format.h>
#include <gl/Context.h>
#include <render/OptionRules.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/GltfLoader.h>
#include <scene/Tool.h>

namespace avsmbench {

namespace {

struct Options {
  std::string scene;
  std::vector<int> sizes = {64, 128, 256, 512, 1024};
  std::vector<double> footprints = {0, 0.8, 3}; ///< millimetres of the scene
  std::vector<std::string> methods = {"lists",          "avsm fitted 4", "avsm fitted 8",
                                      "avsm fitted 16", "avsm whole 8",  "avsm in order 8",
                                      "deep 0.01",      "opacity 32",    "fourier 16"};
  int receivers = 4096;
  std::string csv;
};

void run(const Options& options) {
  const std::unique_ptr<host::Context> context = host::Context::create(host::defaultContextKind(), {/*debug*/ false});
  if (context->glVersion() < 43) throw host::Error("the context is older than OpenGL 4.3");
  if (!options.csv.empty()) host::requireWritable(options.csv);
  Hair hair(host::loadScene(options.scene), options.receivers);
  std::vector<std::vector<double>> truths;
  for (const double footprint : options.footprints) {
    truths.push_back(hair.truth(1e-3 * footprint));
    double mean = 0;
    for (const double passed : truths.back())
      mean += passed / static_cast<double>(options.receivers);
    host::print(
        fmt::format("{} mm: a share of {:.3f} of the light comes to {} places\n", footprint, mean, options.receivers));
  }
  // By method and footprint, a column for each size.
  std::vector<std::vector<std::vector<double>>> errors(options.methods.size(),
                                                       std::vector<std::vector<double>>(options.footprints.size()));
  std::string csv = "method,footprint_mm,size,error\n";
  for (const int size : options.sizes) {
    tyndall::AvsmConfig config;
    config.loader = context->loader();
    config.size = size;
    const tyndall::AvsmResult lists = tyndall::Avsm::create(config);
    if (!lists.avsm) throw host::Error(lists.status.message);
    for (std::size_t m = 0; m < options.methods.size(); ++m) {
      const std::vector<float> answers = hair.answers(methodNamed(options.methods[m]), *lists.avsm, config);
      for (std::size_t f = 0; f < truths.size(); ++f) {
        errors[m][f].push_back(meanDifference(answers, truths[f]));
        csv += fmt::format("{},{},{},{:.6g}\n", options.methods[m], options.footprints[f], size, errors[m][f].back());
      }
      host::say(fmt::format("{}: {}", size, options.methods[m]));
    }
    for (const std::string& error : context->takeErrors())
      throw host::Error(error);
  }
  std::string header = "\n| footprint, mm | method |", rule = "|---|---|";
  for (const int size : options.sizes)
    header += fmt::format(" {}² |", size), rule += "---|";
  host::print(header + "\n" + rule + "\n");
  for (std::size_t f = 0; f < truths.size(); ++f)
    for (std::size_t m = 0; m < options.methods.size(); ++m) {
      std::string row = fmt::format("| {} | {} |", options.footprints[f], options.methods[m]);
      for (const double error : errors[m][f])
        row += fmt::format(" {:.4f} |", error);
      host::print(row + "\n");
    }
  host::print(fmt::format("\n{}\n", context->driver()));
  if (!options.csv.empty()) host::writeText(options.csv, csv);
}

Options parseOptions(int argc, char** argv) {
  Options options;
  std::vector<std::string> methods;
  for (const MethodEntry& entry : allMethods())
    methods.push_back(entry.name);
  CLI::App app("Light on strands by maps of curves, beside geometry: mean difference of transmittance.",
               "tyndall-hair-bench");
  app.add_option("scene", options.scene, "a glTF scene with strands, whose first light is a spot")->required();
  render::addList(app, "--methods", options.methods, render::oneOf("--methods", methods),
                  "as tyndall-avsm-bench has them");
  app.add_option("--sizes", options.sizes, "texels per side of the maps")->delimiter(',')->check(CLI::Range(8, 2048));
  app.add_option("--footprints", options.footprints,
                 "of a place across the light, thousandths of the scene's unit; 0: a point")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1000.0));
  app.add_option("--receivers", options.receivers, "places on strands")->check(CLI::Range(1, 16384));
  app.add_option("--csv", options.csv, "a file for the table");
  render::parseArguments(app, argc, argv);
  return options;
}

} // namespace

} // namespace avsmbench

int main(int argc, char** argv) {
  return render::runCommand("tyndall-hair-bench", [&] {
    avsmbench::run(avsmbench::parseOptions(argc, argv));
    return 0;
  });
}
