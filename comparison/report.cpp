// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "run_program.h"

namespace ga_symmetry::comparison {
namespace {

namespace fs = std::filesystem;

std::string exact(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}
double mean(const std::vector<double>& values) {
  double sum = 0;
  for (double x : values) sum += x;
  return values.empty() ? std::nan("") : sum / static_cast<double>(values.size());
}

// Of those rows that fit, one number each.
template <class Row, class Fits, class Value>
std::vector<double> pick(const std::vector<Row>& rows, const Fits& fits, const Value& value) {
  std::vector<double> out;
  for (const Row& row : rows)
    if (fits(row)) out.push_back(value(row));
  return out;
}

// ---- figures of a method over all meshes

struct Score {
  std::string method;
  std::size_t meshes = 0;
  double mean = 0, corr = 0, mesh_rate = 0, coverage = 0, involution = 0;  // over meshes, each the mean of its runs
  double seconds = 0;                                                      // median over runs
};

std::vector<Score> make_scores(const Comparison& c) {
  std::vector<Score> out;
  for (const std::string& method : c.plan.methods) {
    Score s;
    s.method = method;
    std::vector<double> seconds, means, corrs, good, coverages, involutions;
    for (const std::string& name : c.meshes) {
      const auto fits = [&](const MethodRun& r) { return r.mesh == name && r.method == s.method; };
      const auto over_runs = [&](double Evaluation::*field) {
        return mean(pick(c.runs, fits, [&](const MethodRun& r) { return r.evaluation.*field; }));
      };
      const auto times = pick(c.runs, fits, [](const MethodRun& r) { return r.seconds; });
      if (times.empty()) continue;
      seconds.insert(seconds.end(), times.begin(), times.end());
      means.push_back(over_runs(&Evaluation::mean));
      corrs.push_back(over_runs(&Evaluation::corr));
      good.push_back(corrs.back() > 0.75);
      coverages.push_back(over_runs(&Evaluation::coverage));
      involutions.push_back(over_runs(&Evaluation::involution));
    }
    if (means.empty()) continue;
    s.meshes = means.size();
    s.mean = mean(means), s.corr = mean(corrs), s.mesh_rate = mean(good);
    s.coverage = mean(coverages), s.involution = mean(involutions), s.seconds = median(seconds);
    out.push_back(s);
  }
  return out;
}

// Their generations are written one by one; joint-zoomout runs the same search.
bool is_joint(const std::string& method) { return method == "joint" || method == "joint-auto"; }

class Csv {
 public:
  explicit Csv(const std::string& header) : text_(header + "\n") {}
  void row(const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool quote = cells[i].find_first_of(",\"\n") != std::string::npos;
      std::string cell = cells[i];
      for (std::size_t at = 0; quote && (at = cell.find('"', at)) != cell.npos; at += 2) cell.insert(at, "\"");
      text_ += (i ? "," : "") + (quote ? '"' + cell + '"' : cell);
    }
    text_ += "\n";
  }
  void save(const fs::path& folder, const char* name) const { write_file((folder / name).string(), text_); }

 private:
  std::string text_;
};

void write_tables(const fs::path& folder, const Comparison& c, const std::vector<Score>& scores) {
  const auto integer = [](auto x) { return std::to_string(x); };
  Csv runs(
      "mesh,method,seed,repeat,seconds,mean,corr,coverage,involution,lines,generations,convergence_generation,"
      "search_seconds,stop,failure,diversity");
  Csv generations("mesh,search,regions,z,seed,generation,best,mean,diversity,seconds,optimum,success_threshold");
  for (const MethodRun& r : c.runs) {
    const Evaluation& e = r.evaluation;
    const bool genetic = !r.log.empty();
    runs.row({r.mesh, r.method, integer(r.seed), integer(r.repeat), exact(r.seconds), exact(e.mean), exact(e.corr),
              exact(e.coverage), exact(e.involution), integer(e.lines), genetic ? integer(r.log.size()) : "",
              genetic ? integer(convergence_generation(r.log)) : "", genetic ? exact(r.search_seconds) : "",
              genetic ? to_string(r.stop) : "", r.failure, genetic ? exact(r.log.back().diversity) : ""});
    if (is_joint(r.method) && r.repeat == 1)
      for (const GenerationLog& g : r.log)
        generations.row({r.mesh, r.method, "", "", integer(r.seed), integer(g.generation), exact(g.best), exact(g.mean),
                         exact(g.diversity), "", "", ""});
  }
  runs.save(folder, "runs.csv");

  Csv methods("method,meshes,mean,corr,mesh_rate,coverage,involution,seconds");
  for (const Score& s : scores)
    methods.row({s.method, integer(s.meshes), exact(s.mean), exact(s.corr), exact(s.mesh_rate), exact(s.coverage),
                 exact(s.involution), exact(s.seconds)});
  methods.save(folder, "methods.csv");

  Csv durations("mesh,error,samples,seed,repeat,search,quality,reached,seconds,evaluations,generations,fitness");
  for (const DurationRun& r : c.durations) {
    const Duration& d = r.duration;
    durations.row({r.mesh, r.error, integer(r.samples), integer(r.seed), integer(r.repeat), d.search, exact(d.quality),
                   d.reached ? "yes" : "no", exact(d.seconds), d.evaluations > 0 ? exact(d.evaluations) : "",
                   d.search == "genetic" ? integer(d.generations) : "", exact(d.fitness)});
  }
  durations.save(folder, "durations.csv");

  for (const EvolutionRun& r : c.evolutions)
    for (std::size_t i = 0; i < r.evolution.log.size(); ++i) {
      const GenerationLog& g = r.evolution.log[i];
      generations.row({r.mesh, r.error, integer(r.regions), exact(r.z), integer(r.seed), integer(g.generation),
                       exact(g.best), exact(g.mean), exact(g.diversity), exact(r.evolution.seconds[i]),
                       exact(r.optimum), exact(r.success_threshold)});
    }
  generations.save(folder, "generations.csv");

  Csv curves("method,error,share");
  for (const Score& s : scores)
    for (int i = 0; i <= 60; ++i) {
      const double limit = 0.005 * i;
      const auto share = pick(
          c.runs, [&](const MethodRun& r) { return r.method == s.method; },
          [&](const MethodRun& r) {
            const std::vector<double>& e = r.evaluation.error;
            return static_cast<double>(std::count_if(e.begin(), e.end(), [&](double x) { return x <= limit; })) /
                   static_cast<double>(e.size());
          });
      curves.row({s.method, exact(limit), exact(mean(share))});
    }
  curves.save(folder, "error_curves.csv");
}

// ---- JSON

void write_json(const fs::path& path, const nlohmann::json& json) {  // names of files may be no UTF-8
  write_file(path.string(), json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void write_description(const fs::path& folder, const std::string& command, const Comparison& c) {
  nlohmann::json methods = nlohmann::json::array();
  for (std::size_t k = 0; k < c.texts.size(); ++k)
    methods.push_back({{"name", c.plan.methods[k]}, {"text", c.texts[k]}});
  write_json(folder / "comparison.json", {{"command", command},
                                          {"version", c.version},
                                          {"machine", c.machine},
                                          {"seeds", c.plan.seeds},
                                          {"repeats", c.plan.repeats},
                                          {"threads", c.plan.threads},
                                          {"meshes", c.meshes},
                                          {"methods", methods},
                                          {"notes", c.notes}});
}

void write_pictures(const fs::path& folder, const Comparison& c) {
  nlohmann::json all = nlohmann::json::array();
  for (const Picture& p : c.pictures) {
    nlohmann::json maps = nlohmann::json::array();
    for (const Picture::Map& m : p.maps)
      maps.push_back({{"method", m.method}, {"partner", m.partner}, {"error", m.error}});
    nlohmann::json pairs = nlohmann::json::array();
    for (const SymmetricPair& pair : p.pairs) pairs.push_back({pair.vertex, pair.partner});
    all.push_back({{"mesh", p.mesh},
                   {"position", p.shape.position},
                   {"triangle", p.shape.triangle},
                   {"side", p.side},
                   {"patch", p.patch},
                   {"pairs", pairs},
                   {"maps", maps}});
  }
  write_json(folder / "pictures.json", all);
}

// ---- the page

// Of report.py.
enum PageStatus { kWhole = 0, kNoJinja = 3, kNoPlots = 4 };

// Has report.py make the page. @return what is missing and how to get it; empty = nothing
std::string make_page(const fs::path& folder, const fs::path& target, const Context& context) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path script = program.parent_path().parent_path() / "share" / "ga_symmetry" / "comparison" / "report.py";
  if (error || !fs::exists(script)) return "no page: " + script.string() + " is missing, install the program again";
  const fs::path log = folder / "report.log";
  int status = -1;
  for (const char* python : {"python3", "/usr/bin/python3"}) {  // the first may be one without the system's packages
    const int got = run_program({python, script.string(), folder.string()}, log, context);
    if (status != kNoPlots || got == kWhole) status = got;
    if (status == kWhole) break;
  }
  std::ifstream in(log);
  std::string line, last;
  while (std::getline(in, line)) last = line;
  fs::remove(log, error);
  const std::string again = ", and run: /usr/bin/python3 " + script.string() + " " + target.string();
  switch (status) {
    case kWhole:
      return "";
    case kNoPlots:
      return "no plots: apt-get install python3-matplotlib" + again;
    case kNoJinja:
      return "no page: apt-get install python3-jinja2 python3-matplotlib" + again;
    case 127:
    case -1:
      return "no page: python3 cannot be run; apt-get install python3-jinja2 python3-matplotlib" + again;
    default:
      return "no page: report.py failed: " + last;
  }
}

// A folder that is gone again unless it is committed.
class PendingFolder {
 public:
  explicit PendingFolder(const fs::path& target) : target_(target) {
    std::string name = (fs::absolute(target).parent_path() / (target.filename().string() + ".XXXXXX")).string();
    if (!mkdtemp(name.data())) throw FileError("cannot write " + target.string() + ": is the folder above writable?");
    path_ = name;
  }
  ~PendingFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  PendingFolder(const PendingFolder&) = delete;
  PendingFolder& operator=(const PendingFolder&) = delete;
  const fs::path& path() const { return path_; }
  void commit() {
    std::error_code error;
    fs::permissions(path_, static_cast<fs::perms>(0755), error);
    fs::rename(path_, target_, error);
    if (error) throw FileError("cannot write " + target_.string() + ": " + error.message());
    path_.clear();
  }

 private:
  fs::path target_, path_;
};

fs::path without_slash(const std::string& folder) {
  const fs::path path(folder);
  return path.has_filename() ? path : path.parent_path();
}

}  // namespace

void check_report_folder(const std::string& folder) {
  const fs::path path = without_slash(folder);
  if (path.empty()) throw InvalidOption("the report needs a folder: give a name that does not exist");
  if (fs::exists(fs::symlink_status(path)))
    throw FileError(path.string() + " exists: remove it or choose another folder for the report");
  const PendingFolder probe(path);
}

std::string write_report(const std::string& folder, const std::string& command, const Comparison& comparison,
                         const Context& context) {
  const fs::path target = without_slash(folder);
  PendingFolder pending(target);
  write_tables(pending.path(), comparison, make_scores(comparison));
  write_description(pending.path(), command, comparison);
  write_pictures(pending.path(), comparison);
  const std::string missing = make_page(pending.path(), target, context);
  if (missing.empty()) fs::remove(pending.path() / "pictures.json");  // large, and in the page
  pending.commit();
  return missing;
}

}  // namespace ga_symmetry::comparison
