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

ProgressBar::ProgressBar(bool wanted, const std::string& place)
    : shown_(wanted && isatty(STDERR_FILENO)), place_(place.empty() ? "" : " (" + place + ")") {}

Context ProgressBar::watch(const Context& context) {
  Context out = context;
  out.progress = [this](double fraction, const char* stage) { show(fraction, stage); };
  return out;
}

void ProgressBar::show(double fraction, const char* stage) {
  if (!shown_) return;
  constexpr int kWidth = 30, kLine = 79;  // a line that wraps could not be overwritten
  std::string bar(static_cast<std::size_t>(kWidth * fraction), '#');
  bar.resize(kWidth, '.');
  char percent[16];
  std::snprintf(percent, sizeof percent, "] %3d%% ", static_cast<int>(100 * fraction));
  const std::string line = ("[" + bar + percent + stage + place_).substr(0, kLine);
  if (line == line_) return;
  line_ = line;
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!line_.empty()) std::fputs("\r\033[K", stderr);
  line_.clear();
}

}  // namespace ga_symmetry::tool
