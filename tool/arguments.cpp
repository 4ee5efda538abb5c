// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "ga_symmetry/errors.h"

namespace ga_symmetry::tool {
namespace {

bool is_on(const OptionInfo& info) { return info.kind == OptionKind::flag && info.default_value == "true"; }

std::string help_of(const OptionInfo& info) {
  std::string help = info.help;
  if (is_on(info)) {
    help[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(help[0])));
    help = "Do not " + help;
  }
  if (!info.range.empty()) help += "; " + info.range;
  if (info.kind == OptionKind::choice) help += " [" + info.default_value + "]";
  return help;
}

}  // namespace

std::string flag_of(const OptionInfo& info) {
  std::string name = info.name;
  std::replace(name.begin(), name.end(), '_', '-');
  return (is_on(info) ? "--no-" : "--") + name;
}

void add_core_option(CLI::App& app, const OptionInfo& info, Options& options, std::vector<std::string>& given) {
  const std::string flag = flag_of(info);
  const auto set = [flag, name = info.name, &options, &given](const std::string& value) {
    try {
      set_option(options, name, value);
    } catch (const InvalidOption& error) {
      throw CLI::ValidationError(flag, std::string(error.what()).substr(name.size() + 1));
    }
    given.push_back(name);
  };
  if (info.kind == OptionKind::flag) {
    app.add_flag_callback(
        flag, [set, value = is_on(info) ? "false" : "true"] { set(value); }, help_of(info));
    return;
  }
  CLI::Option& option = *app.add_option_function<std::string>(flag, set, help_of(info));
  if (info.kind == OptionKind::choice) {
    std::string words;
    for (const std::string& word : info.choices) words += (words.empty() ? "" : "|") + word;
    option.type_name(words);
  } else {
    option.type_name(info.kind == OptionKind::integer ? "N" : "X")->default_str(info.default_value);
  }
}

void add_mesh(CLI::App& app, std::string& path) {
  app.add_option("MESH", path, "Triangle mesh: .ply, .off, .obj or .stl")->required()->type_name("");
}

void add_partners(CLI::App& app, std::string& path) {
  app.add_option("PARTNERS", path, "What `find` wrote for this mesh: .csv or .json")->required()->type_name("");
}

void add_threads(CLI::App& app, int& threads) {
  app.add_option("--threads", threads, help_of(option_info("threads")))->type_name("N")->capture_default_str();
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
