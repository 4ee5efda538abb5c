#include "arguments.h"

#include <unistd.h>

#include <cstdio>

namespace ga_symmetry::tool {

void add_mesh(CLI::App& app, std::string& path) {
  app.add_option("MESH", path, "Triangle mesh: .ply, .off, .obj or .stl")->required()->type_name("");
}

void add_partners(CLI::App& app, std::string& path) {
  app.add_option("PARTNERS", path, "What `find` wrote for this mesh: .csv or .json")->required()->type_name("");
}

void add_threads(CLI::App& app, int& threads) {
  app.add_option("--threads", threads, "0 to 256, 0 = all cores; never changes the result")->capture_default_str();
}

void add_output(CLI::App& app, std::string& path, const std::string& help) {
  app.add_option("-o,--output", path, help + "; without it the CSV goes to the standard output")->type_name("FILE");
}

ProgressBar::ProgressBar(bool wanted) : shown_(wanted && isatty(STDERR_FILENO)) {}

Context ProgressBar::watch(const Context& context) {
  Context out = context;
  out.progress = [this](double fraction, const char* stage) { show(fraction, stage); };
  return out;
}

void ProgressBar::show(double fraction, const char* stage) {
  const int percent = static_cast<int>(100 * fraction);
  if (!shown_ || (percent == percent_ && stage == stage_)) return;
  percent_ = percent, stage_ = stage;
  constexpr int kWidth = 30;
  std::string bar(static_cast<std::size_t>(kWidth * fraction), '#');
  bar.resize(kWidth, '.');
  std::fprintf(stderr, "\r\033[K[%s] %3d%% %s", bar.c_str(), percent, stage);
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (percent_ >= 0) std::fputs("\r\033[K", stderr);
  percent_ = -1;
}

}  // namespace ga_symmetry::tool
