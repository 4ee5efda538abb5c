// SPDX-License-Identifier: GPL-3.0-or-later
#include "find_many.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <new>

#include "commands.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "util/csv.h"

namespace ga_symmetry::tool {
namespace {

namespace fs = std::filesystem;

bool is_mesh(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".ply" || ending == ".off" || ending == ".obj" || ending == ".stl";
}

struct Job {
  std::string name, mesh;
  std::vector<std::string> outputs;
};

std::vector<Job> make_jobs(const ManyMeshes& many) {
  std::vector<std::string> meshes;
  for (const std::string& path : many.meshes) {
    if (!fs::is_directory(path)) {
      meshes.push_back(path);
      continue;
    }
    const std::size_t first = meshes.size();
    for (const auto& entry : fs::directory_iterator(path))
      if (is_mesh(entry.path()) && entry.is_regular_file()) meshes.push_back(entry.path().string());
    if (meshes.size() == first)
      throw FileError("no mesh in " + path + ": no file there ends in .ply, .off, .obj or .stl");
    std::sort(meshes.begin() + static_cast<std::ptrdiff_t>(first), meshes.end());
  }
  std::vector<Job> jobs;
  std::map<std::string, std::string> named;
  for (const std::string& mesh : meshes) {
    Job job{fs::path(mesh).stem().string(), mesh, {}};
    if (const auto [it, fresh] = named.try_emplace(job.name, mesh); !fresh)
      throw InvalidOption(it->second + " and " + mesh + " would have the same output: rename one of them");
    for (const std::string& format : many.formats) {
      const fs::path output = fs::path(many.folder) / (job.name + "." + format);
      if (fs::weakly_canonical(output) == fs::weakly_canonical(mesh))
        throw InvalidOption(mesh + " would be overwritten: choose another folder for the outputs");
      if (output.filename() == "summary.csv")
        throw InvalidOption(mesh + " would have the output summary.csv, which is the table of all: rename it");
      job.outputs.push_back(output.string());
    }
    jobs.push_back(std::move(job));
  }
  return jobs;
}

// The summary: a row for each mesh, in the order of the names.
class Summary {
 public:
  explicit Summary(const std::string& folder) : path_((fs::path(folder) / "summary.csv").string()) {
    check_result_path(path_);
    std::ifstream in(path_);
    std::string line;
    for (std::getline(in, line); std::getline(in, line);)
      if (!line.empty()) rows_[first_cell(line)] = line;
  }

  const std::string& path() const { return path_; }

  void done(const std::string& name, const Result& r, double seconds) {
    std::string warnings;
    for (const std::string& warning : r.warnings) warnings += (warnings.empty() ? "" : "; ") + warning;
    CsvWriter row("");
    row.cell(static_cast<int>(r.partners.partner.size())).cell(r.matched).cell(r.confidence).cell(r.mean_fitness);
    row.cell(static_cast<int>(r.log.size())).cell(seconds);
    put(name, "done", row.text(), warnings);
  }
  void failed(const std::string& name, const std::string& why, double seconds) {
    CsvWriter row("");
    row.cell(seconds);
    put(name, "failed", ",,,,," + row.text(), why);
  }
  /// Keeps what is known of it.
  void skipped(const std::string& name) {
    const auto row = rows_.find(csv_cell(name));
    if (row == rows_.end() || row->second.compare(row->first.size(), 6, ",done,") != 0)
      put(name, "skipped", ",,,,,", "finished before");
  }
  void write() const {
    std::string text = "mesh,status,vertices,matched,confidence,mean_fitness,generations,seconds,message\n";
    for (const auto& [name, row] : rows_) text += row + '\n';
    write_file(path_, text);
  }

 private:
  static std::string first_cell(const std::string& row) {
    bool quoted = false;
    std::size_t end = 0;
    for (; end < row.size() && (quoted || row[end] != ','); ++end) quoted ^= row[end] == '"';
    return row.substr(0, end);
  }
  void put(const std::string& name, const char* status, const std::string& figures, const std::string& message) {
    const std::string cell = csv_cell(name);
    rows_[cell] = cell + "," + status + "," + figures + "," + csv_cell(message);
  }

  std::string path_;
  std::map<std::string, std::string> rows_;  // by first cell
};

}  // namespace

void find_many(const ManyMeshes& many, const FindOne& find_one) {
  using Clock = std::chrono::steady_clock;
  const std::vector<Job> jobs = make_jobs(many);
  std::error_code error;
  fs::create_directories(many.folder, error);
  if (error) throw FileError("cannot make the folder " + many.folder + ": " + error.message());
  Summary summary(many.folder);
  std::size_t done = 0, failed = 0, skipped = 0;
  for (const Job& job : jobs) {
    if (!many.redo &&
        std::all_of(job.outputs.begin(), job.outputs.end(), [](const auto& o) { return fs::exists(o); })) {
      ++skipped;
      summary.skipped(job.name);
      continue;
    }
    const auto begin = Clock::now();
    const auto seconds = [&] {
      return std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - begin).count() / 1000.0;
    };
    const auto fail = [&](const char* why) {
      ++failed;
      summary.failed(job.name, why, seconds());
      std::fprintf(stderr, "ga_symmetry: %s: %s\n", job.name.c_str(), why);
    };
    try {
      const std::string place = std::to_string(done + failed + skipped + 1) + "/" + std::to_string(jobs.size());
      const Result result = find_one(job.mesh, job.outputs, place + " " + job.name);
      ++done;
      summary.done(job.name, result, seconds());
    } catch (const Cancelled&) {
      throw Interrupted("interrupted after " + std::to_string(done + failed + skipped) + " of " +
                        std::to_string(jobs.size()) + " meshes: the same command goes on from here");
    } catch (const std::bad_alloc&) {
      fail("out of memory");
    } catch (const std::exception& e) {
      fail(e.what());
    }
    summary.write();
  }
  summary.write();
  if (!many.quiet)
    std::printf("%zu done, %zu skipped, %zu failed: %s\n", done, skipped, failed, summary.path().c_str());
  if (failed)
    throw Error(std::to_string(failed) + " of " + std::to_string(jobs.size()) + " meshes failed: see " +
                summary.path());
}

}  // namespace ga_symmetry::tool
