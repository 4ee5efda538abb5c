// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/result.h"
#include "util/csv.h"

namespace ga_symmetry {
namespace {

namespace fs = std::filesystem;

enum class Format { csv, json, ply };

Format format_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".csv") return Format::csv;
  if (ending == ".json") return Format::json;
  if (ending == ".ply") return Format::ply;
  throw InvalidOption("cannot write " + (path.empty() ? "a file without a name" : path) +
                      ": its name must end in .csv, .json or .ply");
}

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw FileError("cannot write " + path + ": " + why);
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// A file that is written beside its place and takes it when all is well; else nothing is left of it.
class PendingFile {
 public:
  explicit PendingFile(const std::string& path) : path_(path), target_(path) {
    std::error_code error;
    if (fs::is_symlink(target_, error)) target_ = fs::weakly_canonical(target_, error);  // write through a link
    const std::string stem = (folder_of(target_) / ".ga_symmetry-").string() + std::to_string(::getpid()) + "-";
    int file = -1;
    for (int attempt = 0; file < 0; ++attempt) {
      temporary_ = stem + std::to_string(attempt) + ".part";
      file = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
      if (file < 0 && errno != EEXIST) fail(path_, std::generic_category().message(errno));
    }
    ::close(file);
  }
  ~PendingFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  void write(const std::string& bytes, const Context& context = {}) const {
    constexpr std::size_t kPiece = 1 << 24;
    errno = 0;
    std::ofstream out(temporary_, std::ios::binary);
    for (std::size_t at = 0; at < bytes.size() && out; at += kPiece) {
      if (context.cancelled()) throw Cancelled();
      out.write(bytes.data() + at, static_cast<std::streamsize>(std::min(kPiece, bytes.size() - at)));
    }
    out.close();
    if (!out) fail(path_, errno ? std::generic_category().message(errno) : "it could not be written whole");
  }
  // The bytes reach the disk before the name does.
  void sync() const {
    const int file = ::open(temporary_.c_str(), O_WRONLY | O_CLOEXEC);
    const bool synced = file >= 0 && (::fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP);
    const int error = errno;
    if (file >= 0) ::close(file);
    if (!synced) fail(path_, std::generic_category().message(error));
  }
  void commit() {
    std::error_code error;
    fs::rename(temporary_, target_, error);
    if (error) fail(path_, error.message());
    temporary_.clear();
  }

 private:
  std::string path_;
  fs::path target_;
  std::string temporary_;
};

void stop_at(std::size_t v, const Context& context) {
  if (v % 65536 == 0 && context.cancelled()) throw Cancelled();
}

std::string to_csv(const Result& result, const Context& context) {
  CsvWriter table("vertex,partner,fitness,side");
  for (std::size_t v = 0; v < result.partners.partner.size(); ++v) {
    stop_at(v, context);
    table.cell(static_cast<int>(v))
        .cell(result.partners.partner[v])
        .cell(result.partners.fitness[v])
        .cell(result.partners.side[v])
        .end_row();
  }
  return table.text();
}

using Json = nlohmann::ordered_json;

Json to_json(double value) { return value; }
Json to_json(int value) { return value; }
Json to_json(const SurfacePoint& p) {
  return {p.vertex[0], p.vertex[1], p.vertex[2], p.weight[0], p.weight[1], p.weight[2]};
}

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// All of Result but the seconds, which would make the files of two equal runs differ.
std::string to_json(const TriangleMesh& mesh, const Result& result, const Context& context) {
  Json json;
  json["format"] = "ga_symmetry result";
  json["version"] = 1;
  json["mesh"] = {{"vertices", mesh.vertices()}, {"triangles", mesh.triangles()}, {"checksum", checksum_text(mesh)}};
  json["kind"] = to_string(result.kind);
  json["order"] = result.order;
  json["seed"] = result.seed;
  json["stop"] = to_string(result.stop);
  json["matched"] = result.matched;
  json["mean_fitness"] = result.mean_fitness;
  json["confidence"] = result.confidence;
  json["axis_references"] = result.axis_references;
  json["pair_references"] = result.pair_references;
  json["surface"] = result.surface;
  json["warnings"] = result.warnings;
  json["symmetries"] = Json::array();
  for (const FoundSymmetry& s : result.symmetries)
    json["symmetries"].push_back(
        {{"kind", to_string(s.kind)}, {"order", s.order}, {"rank", s.rank}, {"score", s.score}});
  json["pairs"] = Json::array();
  for (const SymmetricPair& p : result.pairs)
    json["pairs"].push_back({{"vertex", p.vertex}, {"partner", p.partner}, {"fitness", p.fitness}});
  json["axis"] = Json::array();
  for (const auto& line : result.axis) {
    Json points = Json::array();
    for (const SurfacePoint& p : line) points.push_back(to_json(p));
    json["axis"].push_back(std::move(points));
  }
  json["log"] = Json::array();
  for (const GenerationLog& g : result.log)
    json["log"].push_back(
        {{"generation", g.generation}, {"best", g.best}, {"mean", g.mean}, {"diversity", g.diversity}});
  std::string out = dump(json);
  out.pop_back();
  // What is long goes out value by value: as one document it would take many times its size in memory.
  const auto append = [&](const char* name, const auto& values) {
    out += std::string(",\"") + name + "\":[";
    for (std::size_t v = 0; v < values.size(); ++v) {
      stop_at(v, context);
      if (v > 0) out += ',';
      out += dump(to_json(values[v]));
    }
    out += ']';
  };
  append("partner", result.partners.partner);
  append("fitness", result.partners.fitness);
  append("side", result.partners.side);
  append("partner_point", result.partner_point);
  return out + "}\n";
}

template <class Value>
void append_little_endian(std::string& out, Value value) {
  static_assert(sizeof value <= 8);
  unsigned char bytes[sizeof value];
  std::uint64_t bits = 0;
  if constexpr (std::is_floating_point_v<Value>) {
    std::conditional_t<sizeof value == 4, std::uint32_t, std::uint64_t> pattern;
    static_assert(sizeof pattern == sizeof value);
    std::memcpy(&pattern, &value, sizeof value);
    bits = pattern;
  } else {
    bits = static_cast<std::uint64_t>(value);
  }
  for (std::size_t i = 0; i < sizeof value; ++i) bytes[i] = static_cast<unsigned char>(bits >> 8 * i);
  out.append(reinterpret_cast<const char*>(bytes), sizeof value);
}

// The attributes are float, because MeshLab's own are.
std::string to_ply(const TriangleMesh& mesh, const Result& result, ColorBy color_by, const Context& context) {
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment made by ga_symmetry\nelement vertex " +
                    std::to_string(mesh.vertices()) +
                    "\nproperty double x\nproperty double y\nproperty double z\n"
                    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                    "property double quality\nproperty float symmetry_partner\nproperty float symmetry_fitness\n"
                    "property float symmetry_side\nelement face " +
                    std::to_string(mesh.triangles()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  constexpr std::size_t kVertex = 3 * 8 + 4 + 8 + 3 * 4, kFace = 1 + 3 * 4;
  const std::size_t vertices = result.partners.partner.size();
  out.reserve(out.size() + kVertex * vertices + kFace * mesh.triangle.size() / 3);
  const std::vector<Color> colors = vertex_colors(mesh, result.partners, color_by);
  for (std::size_t v = 0; v < vertices; ++v) {
    stop_at(v, context);
    for (int k = 0; k < 3; ++k) append_little_endian(out, mesh.position[3 * v + k]);
    for (const std::uint8_t part : colors[v]) append_little_endian(out, part);
    append_little_endian(out, std::uint8_t{255});
    append_little_endian(out, result.partners.fitness[v]);
    append_little_endian(out, static_cast<float>(result.partners.partner[v]));
    append_little_endian(out, static_cast<float>(result.partners.fitness[v]));
    append_little_endian(out, static_cast<float>(result.partners.side[v]));
  }
  for (std::size_t c = 0; c < mesh.triangle.size(); ++c) {
    stop_at(c, context);
    if (c % 3 == 0) out += '\3';
    append_little_endian(out, static_cast<std::int32_t>(mesh.triangle[c]));
  }
  return out;
}

void check_fits(const TriangleMesh& mesh, const Result& result) {
  const std::size_t n = mesh.position.size() / 3;
  if (result.partners.partner.size() != n || result.partners.fitness.size() != n || result.partners.side.size() != n)
    throw InvalidOption("the result is not of this mesh: it has " + std::to_string(result.partners.partner.size()) +
                        " vertices, the mesh " + std::to_string(n));
}

}  // namespace

std::uint64_t mesh_checksum(const TriangleMesh& mesh) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) hash = (hash ^ (value >> 8 * i & 0xff)) * 1099511628211u;
  };
  add(static_cast<std::uint64_t>(mesh.vertices()), 8);
  add(static_cast<std::uint64_t>(mesh.triangles()), 8);
  for (double x : mesh.position) {
    const float single = static_cast<float>(x);
    std::uint32_t bits;
    std::memcpy(&bits, &single, sizeof bits);
    add(bits, 4);
  }
  for (int v : mesh.triangle) add(static_cast<std::uint32_t>(v), 4);
  return hash;
}

std::string checksum_text(const TriangleMesh& mesh) {
  char text[32];
  std::snprintf(text, sizeof text, "fnv1a64:%016llx", static_cast<unsigned long long>(mesh_checksum(mesh)));
  return text;
}

void write_file(const std::string& path, const std::string& bytes) {
  PendingFile file(path);
  file.write(bytes);
  file.sync();
  file.commit();
}

void check_result_path(const std::string& path) {
  format_of(path);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none) fail(path, error.message());
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(path, "there is something that is not a file");
  const fs::path folder = folder_of(fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : fs::path(path));
  if (!fs::is_directory(folder, error)) fail(path, "there is no folder " + folder.string());
  const PendingFile probe(path);
}

void write_results(const std::vector<std::string>& paths, const TriangleMesh& mesh, const Result& result,
                   const Context& context, ColorBy color_by) {
  check_fits(mesh, result);
  for (const std::string& path : paths) check_result_path(path);
  std::vector<std::unique_ptr<PendingFile>> files;
  for (const std::string& path : paths) {
    context.report(static_cast<double>(files.size()) / static_cast<double>(paths.size()), "writing");
    files.push_back(std::make_unique<PendingFile>(path));
    const PendingFile& file = *files.back();
    switch (format_of(path)) {
      case Format::csv:
        file.write(to_csv(result, context), context);
        break;
      case Format::json:
        file.write(to_json(mesh, result, context), context);
        break;
      case Format::ply:
        file.write(to_ply(mesh, result, color_by, context), context);
        break;
    }
    stop_at(0, context);
    file.sync();
  }
  stop_at(0, context);
  for (const auto& file : files) file->commit();
}

void write_result(const std::string& path, const TriangleMesh& mesh, const Result& result) {
  write_results({path}, mesh, result);
}

}  // namespace ga_symmetry
