// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "ga_symmetry/errors.h"
#include "util/text_scan.h"

namespace ga_symmetry::comparison {
namespace {

namespace fs = std::filesystem;

// Calls read(words) for each line that is not empty; what it throws gets the file and the line.
void for_lines(const fs::path& path, const std::function<void(const std::vector<std::string_view>&)>& read) {
  LineReader lines("");
  try {
    const std::string text = read_text(path.string());
    lines = LineReader(text);
    for (std::string_view line; lines.next(line);)
      if (const auto words = split(line); !words.empty()) read(words);
  } catch (const FileError& error) {
    throw FileError("cannot read " + path.string() + ": " +
                    (lines.number() > 0 ? "line " + std::to_string(lines.number()) + ": " : "") + error.what());
  }
}

// A whole number in [first, first + count), counted from 0.
int parse_index(std::string_view word, int first, int count, const char* what) {
  const auto number = parse_number<int>(word);
  if (!number || *number < first || *number - first >= count)
    throw FileError("expected the number of a " + std::string(what) + ", " + std::to_string(first) + " to " +
                    std::to_string(first + count - 1) + ", got " + std::string(word.substr(0, 40)));
  return *number - first;
}

std::vector<int> read_vertices(const fs::path& path, int first, int vertices) {
  std::vector<int> out;
  for_lines(path, [&](const auto& words) { out.push_back(parse_index(words[0], first, vertices, "vertex")); });
  return out;
}

Truth read_landmarks(const fs::path& landmarks, const fs::path& pairs, int vertices) {
  const std::vector<int> vertex = read_vertices(landmarks, 0, vertices);
  Truth out;
  for_lines(pairs, [&](const auto& words) {
    if (words.size() > 2) throw FileError("expected one or two numbers of landmarks");
    const auto at = [&](std::size_t k) {
      return vertex[parse_index(words[k], 0, static_cast<int>(vertex.size()), "landmark")];
    };
    const int v = at(0), w = at(words.size() - 1);
    out.push_back({v, w});
    if (v != w) out.push_back({w, v});
  });
  return out;
}

Truth read_line_by_line(const fs::path& from, const fs::path& to, int vertices) {
  const std::vector<int> v = read_vertices(from, 1, vertices), w = read_vertices(to, 1, vertices);
  if (v.size() != w.size())
    throw FileError("cannot read " + to.string() + ": it has " + std::to_string(w.size()) + " lines, " +
                    from.filename().string() + " has " + std::to_string(v.size()));
  Truth out;
  for (std::size_t i = 0; i < v.size(); ++i) out.push_back({v[i], w[i]});
  return out;
}

References read_two_and_a_pair(const std::string& path, int vertices) {
  const References r = read_references(path);
  if (r.axis.size() != 2 || r.pairs.size() != 1)
    throw FileError("cannot read " + path + ": expected four different vertices `a0 a1 l r`");
  for (const int v : {r.axis[0], r.axis[1], r.pairs[0][0], r.pairs[0][1]})
    if (v >= vertices)
      throw FileError("cannot read " + path + ": vertex " + std::to_string(v) + " of " + std::to_string(vertices));
  return r;
}

// NAME, NAME without the digits at its end, or the only landmarks there are.
std::string landmarks_of(const fs::path& folder, const std::string& name) {
  for (const std::string& stem : {name, name.substr(0, name.find_last_not_of("0123456789") + 1)})
    if (!stem.empty() && fs::exists(folder / (stem + ".pid"))) return stem;
  std::vector<std::string> all;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".pid") all.push_back(entry.path().stem().string());
  return all.size() == 1 ? all[0] : "";
}

}  // namespace

KnownSymmetry read_known_symmetry(const std::string& mesh_path, const std::string& folder, int vertices) {
  if (!fs::is_directory(folder)) throw FileError("there is no folder " + folder);
  const std::string name = fs::path(mesh_path).stem().string();
  const auto file = [&](const std::string& stem, const char* ending) { return fs::path(folder) / (stem + ending); };
  KnownSymmetry out;
  if (const fs::path truth = file(name, ".truth"); fs::exists(truth)) {
    for_lines(truth, [&](const auto& words) {
      if (words.size() != 2) throw FileError("expected two vertices `v w`");
      const int v = parse_index(words[0], 0, vertices, "vertex");
      out.truth.push_back({v, parse_index(words[1], 0, vertices, "vertex")});
    });
    if (const fs::path references = file(name, ".refs"); fs::exists(references))
      out.references = read_two_and_a_pair(references.string(), vertices);
    out.path = truth.string();
  } else if (const fs::path from = file(name, ".vts"); fs::exists(from)) {
    out.truth = read_line_by_line(from, file(name, ".sym.vts"), vertices);
    out.path = from.string();
  } else if (const std::string stem = landmarks_of(folder, name); !stem.empty()) {
    out.truth = read_landmarks(file(stem, ".pid"), file(stem, ".sym.info"), vertices);
    out.path = file(stem, ".pid").string();
  } else {
    throw FileError("nothing is known of " + name + ": " + folder + " has neither " + name + ".truth nor " + name +
                    ".vts nor " + name + ".pid");
  }
  if (out.truth.empty()) throw FileError("cannot read " + out.path + ": it names no pair");
  return out;
}

}  // namespace ga_symmetry::comparison
