#include "report.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"

extern char** environ;

namespace ga_symmetry::tool {
namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

std::string format(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}
std::string exact(double value) { return format("%.9g", value); }

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
  std::string method, text;
  std::size_t meshes = 0;
  double mean = 0, corr = 0, mesh_rate = 0, coverage = 0, involution = 0;  // over meshes, each the mean of its runs
  double seconds = 0;                                                      // median over runs
};

std::vector<Score> make_scores(const Comparison& c) {
  std::vector<Score> out;
  for (std::size_t k = 0; k < c.methods.size(); ++k) {
    Score s{c.methods[k], c.texts[k]};
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

bool is_automatic(const std::string& method) {
  return method.size() > 5 && method.compare(method.size() - 5, 5, "-auto") == 0;
}
bool is_joint(const std::string& method) { return method == "joint" || method == "joint-auto"; }

// ---- CSV

class Csv {
 public:
  explicit Csv(const std::string& header) : text_(header + "\n") {}
  void row(const Strings& cells) {
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
      "search_seconds,stop,failure");
  Csv generations("mesh,search,regions,z,seed,generation,best,mean,diversity,seconds,optimum");
  for (const MethodRun& r : c.runs) {
    const Evaluation& e = r.evaluation;
    const bool genetic = !r.log.empty();
    runs.row({r.mesh, r.method, integer(r.seed), integer(r.repeat), exact(r.seconds), exact(e.mean), exact(e.corr),
              exact(e.coverage), exact(e.involution), integer(e.lines), genetic ? integer(r.log.size()) : "",
              genetic ? integer(bench::convergence_generation(r.log)) : "", genetic ? exact(r.search_seconds) : "",
              genetic ? to_string(r.stop) : "", r.failure});
    if (is_joint(r.method) && r.repeat == 1)
      for (const GenerationLog& g : r.log)
        generations.row({r.mesh, r.method, "", "", integer(r.seed), integer(g.generation), exact(g.best), exact(g.mean),
                         exact(g.diversity), "", ""});
  }
  runs.save(folder, "runs.csv");

  Csv methods("method,meshes,mean,corr,mesh_rate,coverage,involution,seconds");
  for (const Score& s : scores)
    methods.row({s.method, integer(s.meshes), exact(s.mean), exact(s.corr), exact(s.mesh_rate), exact(s.coverage),
                 exact(s.involution), exact(s.seconds)});
  methods.save(folder, "methods.csv");

  Csv durations("mesh,error,samples,seed,repeat,search,quality,reached,seconds,evaluations,generations,fitness");
  for (const DurationRun& r : c.durations) {
    const bench::Duration& d = r.duration;
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
                       exact(r.optimum)});
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

// ---- the page

std::string escaped(const std::string& text) {
  std::string out;
  for (char ch : text) switch (ch) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += ch;
    }
  return out;
}

// Cells are HTML; the first of each row names it.
std::string html_table(const Strings& head, const std::vector<Strings>& rows) {
  const auto line = [](const Strings& cells, const char* tag) {
    std::string out = "<tr>";
    for (const std::string& cell : cells) out += std::string("<") + tag + ">" + cell + "</" + tag + ">";
    return out + "</tr>\n";
  };
  std::string out = "<div class=\"wide\"><table>\n" + line(head, "th");
  for (const Strings& row : rows) out += line(row, "td");
  return out + "</table></div>\n";
}

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])) : 0u;
    };
    const unsigned bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int k = 0; k < 4; ++k)
      out += i + static_cast<std::size_t>(k) > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
  }
  return out;
}

std::string list(const Strings& items, const char* between = ", ") {
  std::string out;
  for (const std::string& item : items) out += (out.empty() ? "" : between) + item;
  return out;
}

class Page {
 public:
  Page(const fs::path& folder, const Comparison& c) : folder_(folder), c_(c) {
    Strings seeds;
    for (std::uint64_t s : c.seeds) seeds.push_back(std::to_string(s));
    source_ = "<details class=\"source\"><summary>seeds " + list(seeds) + ", " + std::to_string(c.repeats) +
              (c.repeats == 1 ? " repeat" : " repeats") + "; command</summary><code>" + escaped(c.command) +
              "</code></details>\n";
  }
  void heading(const std::string& text) { body_ += "<h2>" + text + "</h2>\n"; }
  void paragraph(const std::string& html) { body_ += "<p>" + html + "</p>\n"; }
  void items(const Strings& lines) {
    body_ += "<ul>\n";
    for (const std::string& l : lines) body_ += "<li>" + l + "</li>\n";
    body_ += "</ul>\n";
  }
  void table(const std::string& caption, const Strings& head, const std::vector<Strings>& rows) {
    body_ += "<p class=\"caption\">" + caption + "</p>\n" + html_table(head, rows) + source_;
  }
  // Nothing where the plot was not drawn.
  void figure(const std::string& file, const std::string& caption) {
    std::ifstream in(folder_ / file, std::ios::binary);
    if (!in) return;
    std::ostringstream bytes;
    bytes << in.rdbuf();
    body_ += "<figure><figcaption>" + caption + "</figcaption><img alt=\"" + escaped(caption) +
             "\" src=\"data:image/png;base64," + base64(bytes.str()) + "\"></figure>\n" + source_;
  }
  std::string text() const {
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>ga_symmetry: comparison</title>\n"
           "<style>\nbody { font: 16px/1.5 sans-serif; max-width: 78em; margin: 2em auto; padding: 0 1em; color: #222 "
           "}\n"
           "h1, h2 { line-height: 1.2 } h2 { margin-top: 2em; border-top: 1px solid #ccc; padding-top: 0.7em }\n"
           ".wide { overflow-x: auto }\ntable { border-collapse: collapse; font-size: 14px }\n"
           "th, td { padding: 0.25em 0.8em; text-align: right; border-bottom: 1px solid #ddd; white-space: nowrap }\n"
           "th { vertical-align: bottom; background: #f2f2f2 }\n"
           "th:first-child, td:first-child, .text { text-align: left }\n"
           ".text { display: block; white-space: normal; min-width: 16em }\n"
           "figure { margin: 1.5em 0 0 } img { max-width: 100%; height: auto }\n"
           "figcaption, .caption { font-weight: bold; margin: 1.2em 0 0.4em }\n"
           ".source { font-size: 12px; color: #666; margin: 0.2em 0 1em }\ncode { overflow-wrap: anywhere }\n"
           "</style></head><body>\n" +
           body_ + "</body></html>\n";
  }

 private:
  fs::path folder_;
  const Comparison& c_;
  std::string source_, body_;
};

std::string times(double ratio) { return std::isfinite(ratio) ? format(ratio < 10 ? "%.2f" : "%.0f", ratio) : "-"; }

// Where the joint search stands against the others that were given as much as it.
Strings verdict(const std::vector<Score>& scores) {
  Strings out;
  for (const bool automatic : {false, true}) {
    const auto joint = std::find_if(scores.begin(), scores.end(), [&](const Score& s) {
      return is_joint(s.method) && is_automatic(s.method) == automatic;
    });
    if (joint == scores.end()) continue;
    Strings better_mean, better_corr, faster;
    double refined = std::nan("");
    for (const Score& s : scores) {
      if (&s == &*joint || is_automatic(s.method) != automatic || s.method.rfind("joint", 0) == 0) continue;
      if (s.mean < joint->mean) better_mean.push_back(s.method);
      if (s.corr > joint->corr) better_corr.push_back(s.method);
      if (s.seconds < joint->seconds) faster.push_back(s.method);
      if (s.method == (automatic ? "zoomout-auto" : "zoomout")) refined = s.seconds / joint->seconds;
    }
    const auto behind = [](const Strings& who) { return who.empty() ? std::string("nobody") : list(who); };
    out.push_back("<b>" + joint->method + "</b>: mean error " + format("%.4f", joint->mean) + ", corr " +
                  format("%.1f %%", 100 * joint->corr) + ", " + format("%.2f s", joint->seconds) +
                  ". Lower mean error: " + behind(better_mean) + ". Higher corr: " + behind(better_corr) +
                  ". Faster: " + behind(faster) + "." +
                  (std::isfinite(refined) ? " Spectral refinement takes " + times(refined) + " times as long." : ""));
  }
  return out;
}

void add_accuracy(Page& page, const Comparison& c, const std::vector<Score>& scores) {
  page.heading("Accuracy beside time");
  page.paragraph(
      "Errors are geodesic distances to the true partner over the square root of the area, by first-order fast "
      "marching. "
      "<i>Corr</i>: share of the truth's vertices with an error below 0.126. <i>Mesh rate</i>: share of meshes with a "
      "corr above 0.75. <i>Coverage</i>: share of vertices with a partner. <i>Involution</i>: share whose partner's "
      "partner is near. Time is wall clock, from the mesh in memory to a partner for every vertex, on the same "
      "threads, "
      "the methods in turn. Methods that end in -auto know nothing but the mesh; all others were given two axis "
      "vertices "
      "and a pair.");
  std::vector<Strings> rows;
  for (const Score& s : scores)
    rows.push_back({s.method, format("%.4f", s.mean), format("%.1f %%", 100 * s.corr),
                    format("%.0f %%", 100 * s.mesh_rate), format("%.1f %%", 100 * s.coverage),
                    format("%.1f %%", 100 * s.involution), format("%.2f", s.seconds),
                    "<span class=\"text\">" + escaped(s.text) + "</span>"});
  page.table("All methods, over " + std::to_string(c.meshes.size()) + (c.meshes.size() == 1 ? " mesh" : " meshes"),
             {"method", "mean error", "corr", "mesh rate", "coverage", "involution", "seconds<br>(median)",
              "<span class=\"text\">what it is</span>"},
             rows);
  page.figure("accuracy.png", "Accuracy beside time; hollow marks: without references");
  page.figure("error_curves.png", "Error curves: share of vertices with an error of at most x");
  rows.clear();
  Strings head{"mesh"};
  for (const Score& s : scores) head.push_back(s.method);
  for (const std::string& name : c.meshes) {
    Strings row{escaped(name)};
    for (const Score& s : scores) {
      const auto errors = pick(
          c.runs, [&](const MethodRun& r) { return r.mesh == name && r.method == s.method; },
          [](const MethodRun& r) { return r.evaluation.mean; });
      row.push_back(errors.empty() ? "" : format("%.3f", mean(errors)));
    }
    rows.push_back(row);
  }
  page.table("Mean error on each mesh", head, rows);
}

void add_durations(Page& page, const Comparison& c) {
  if (c.durations.empty()) return;
  page.heading("Table 1: durations of the search for pairs");
  page.paragraph(
      "The paper's table: naive search 156.37 ms, its genetic algorithm 119.89 ms with squared (0.77 of naive) and "
      "145.08 ms with linear error (0.93), without saying how many samples there were or how good the pairs. Here all "
      "work on the same samples and stop at the same quality: the mean fitness of the samples' pairs over the "
      "optimum's. "
      "<i>naive</i> tries every pair, so it finds the optimum; <i>kdtree</i> finds the same one; <i>genetic</i> is the "
      "paper's algorithm (4 individuals a sample, 5 regions, z = 1.96); <i>scan</i> is naive search that also stops "
      "early: candidates in random order, until their mean is good enough. Processor time of one thread for the search "
      "alone, medians; the ratio is to naive on the same mesh, in the same turn.");
  for (const bool all : {false, true}) {
    std::vector<Strings> rows;
    double samples = 0;
    for (const char* error : {"squared", "linear"}) {
      // Each mesh has two counts of samples, small and large.
      const auto in_group = [&](const DurationRun& r) {
        int low = r.samples, high = r.samples;
        for (const DurationRun& o : c.durations)
          if (o.mesh == r.mesh) low = std::min(low, o.samples), high = std::max(high, o.samples);
        return r.error == error && r.samples == (all ? high : low);
      };
      std::vector<DurationRun> group;
      for (const DurationRun& r : c.durations)
        if (in_group(r)) group.push_back(r);
      samples = median(pick(
          group, [](const DurationRun&) { return true; }, [](const DurationRun& r) { return r.samples; }));
      std::map<std::pair<std::string, double>, std::vector<double>> seconds, ratios, evaluations, gens, reached;
      std::vector<std::pair<std::string, double>> order;
      double naive_seconds = 0;
      for (const DurationRun& r : group) {
        const bench::Duration& d = r.duration;
        if (d.search == "naive") naive_seconds = d.seconds;  // it opens each turn
        const auto key = std::make_pair(d.search, d.quality);
        if (!seconds.count(key)) order.push_back(key);
        seconds[key].push_back(d.seconds);
        ratios[key].push_back(d.seconds / naive_seconds);
        evaluations[key].push_back(d.evaluations);
        gens[key].push_back(d.generations);
        reached[key].push_back(d.reached);
      }
      for (const auto& key : order) {
        const bool genetic = key.first == "genetic";
        const double share = mean(reached[key]), work = median(evaluations[key]);
        rows.push_back({key.first, error, key.second > 0 ? format("within %.0f %%", 100 * key.second) : "optimum",
                        format("%.2f", 1e3 * median(seconds[key])),
                        (share < 0.5 ? "&gt; " : "") + times(median(ratios[key])),
                        work > 0 ? format("%.0f", work / 1000) : "", genetic ? format("%.0f", median(gens[key])) : "",
                        format("%.0f %%", 100 * share)});
      }
    }
    page.table(std::string(all ? "As many samples as the meshes have vertices" : "The default number of samples") +
                   ": " + format("%.0f", samples) + " on each side (median)",
               {"search", "error", "quality", "ms (median)", "ratio to naive", "thousand pairs<br>evaluated, at most",
                "generations<br>(median)", "reached it"},
               rows);
  }
  page.paragraph(
      "How to read it: a ratio below 1 is faster than the naive search for the optimum. Naive search evaluates each "
      "pair "
      "of samples once; the genetic algorithm evaluates 4 pairs a sample and generation and keeps account of them, so "
      "it "
      "is ahead only where it may stop after few generations, which means at low quality, and where there are many "
      "samples. Compare it with <i>scan</i> at the same quality, too. No search of pairs needs to be slow: the k-d "
      "tree "
      "finds the optimum in a fraction of the time.");
}

void add_generations(Page& page, const Comparison& c) {
  if (c.evolutions.empty()) return;
  page.heading("Figure 2: fitness against generation; convergence and diversity");
  page.figure("generations.png",
              "Best fitness (mean over the samples of their best pair) over the optimum, against the generation");
  page.figure("diversity.png", "Diversity: share of distinct individuals, against the generation");
  page.figure("joint.png", "The joint search: cost of the best map over its last value, and diversity");
  std::map<std::tuple<std::string, int, double>, std::vector<const EvolutionRun*>> groups;
  for (const EvolutionRun& r : c.evolutions) groups[{r.error, r.regions, r.z}].push_back(&r);
  std::vector<Strings> rows;
  for (const auto& [key, runs] : groups) {
    std::vector<double> generation, seconds, gap, diversity, success, succeeded;
    for (const EvolutionRun* r : runs) {
      const auto& log = r->evolution.log;
      generation.push_back(bench::convergence_generation(log));
      seconds.push_back(r->evolution.seconds[static_cast<std::size_t>(generation.back())]);
      gap.push_back(log.back().best / r->optimum - 1);
      diversity.push_back(log.back().diversity);
      const auto at =
          std::find_if(log.begin(), log.end(), [&](const GenerationLog& g) { return g.best <= r->success_threshold; });
      succeeded.push_back(at != log.end());
      if (at != log.end()) success.push_back(at->generation);
    }
    rows.push_back({std::get<0>(key), std::to_string(std::get<1>(key)), format("%.2f", std::get<2>(key)),
                    format("%.0f", median(generation)), format("%.1f", 1e3 * median(seconds)),
                    format("%.0f %%", 100 * median(gap)), format("%.0f %%", 100 * mean(succeeded)),
                    success.empty() ? "-" : format("%.0f", median(success)), format("%.2f", median(diversity))});
  }
  page.table("The paper's genetic algorithm, 300 generations, medians over meshes and seeds",
             {"error", "regions", "z", "convergence<br>generation", "ms until then", "above the optimum<br>at the end",
              "reaches the fitness<br>of the given pair", "in generation", "diversity<br>at the end"},
             rows);
  page.paragraph(
      "The <i>convergence generation</i> is the first whose best is within 5 % of the whole fall to the last. A z of "
      "1.96 "
      "means that pairs with a Z-error above 1.96 mutate and below -1.96 stay.");
  rows.clear();
  for (const std::string& method : c.methods) {
    const auto fits = [&](const MethodRun& r) { return r.method == method && r.log.size() > 1; };
    const auto generation = pick(c.runs, fits, [](const MethodRun& r) { return bench::convergence_generation(r.log); });
    if (generation.empty() || method.rfind("joint-zoomout", 0) == 0) continue;
    const auto all = pick(c.runs, fits, [](const MethodRun& r) { return static_cast<double>(r.log.size()); });
    const auto whole = pick(c.runs, fits, [](const MethodRun& r) { return r.search_seconds; });
    const auto share = pick(c.runs, fits, [](const MethodRun& r) {
      return r.search_seconds * (bench::convergence_generation(r.log) + 1) / static_cast<double>(r.log.size());
    });
    const auto diversity = pick(c.runs, fits, [](const MethodRun& r) { return r.log.back().diversity; });
    rows.push_back({method, format("%.0f", median(all)), format("%.0f", median(generation)),
                    format("%.2f", median(whole)), format("%.2f", median(share)), format("%.2f", median(diversity))});
  }
  page.table("Genetic searches as a user runs them, medians",
             {"method", "generations", "convergence<br>generation", "search, s", "of it until<br>convergence, s",
              "diversity<br>at the end"},
             rows);
}

std::string make_page(const fs::path& folder, const Comparison& c, const std::vector<Score>& scores,
                      const Strings& messages) {
  Page page(folder, c);
  const auto plain = [](const std::string& text) { return escaped(text); };
  page.paragraph("<span style=\"font-size: 28px; font-weight: bold\">Comparison of intrinsic symmetry searches</span>");
  page.paragraph("Made by <code>" + plain(c.command) + "</code>, version " + plain(c.version) + ", on " +
                 plain(c.machine) + (c.threads ? ", " + std::to_string(c.threads) + " used" : ", all used") +
                 ". Meshes: " + plain(list(c.meshes)) + ".");
  Strings notes = verdict(scores);
  for (const std::string& n : c.notes) notes.push_back(plain(n));
  for (const std::string& m : messages) notes.push_back(plain(m));
  page.items(notes);
  add_accuracy(page, c, scores);
  add_durations(page, c);
  add_generations(page, c);
  if (!c.pictures.empty() && fs::exists(folder / "map_0.png")) {
    page.heading("Figures 1 and 3: samples and pairs");
    page.figure("patches.png", "Figure 1: evenly spaced samples; every vertex has the colour of its nearest sample");
    page.figure("pairs.png", "Figure 3: symmetric pairs found by joint, with lines");
    page.heading("The maps");
    page.paragraph(
        "Upper row: the left side is coloured by place, the right by the place of each vertex's partner; a right map "
        "paints both sides alike. Lower row: the error, from white (0) to dark red (0.25 and more), at the measured "
        "vertices and their surroundings.");
    for (std::size_t i = 0; i < c.pictures.size(); ++i)
      page.figure("map_" + std::to_string(i) + ".png", plain(c.pictures[i].mesh));
  }
  return page.text();
}

// ---- plots

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
  std::ofstream(folder / "pictures.json") << all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Runs a program with its output in a file. @return its exit status, -1 if it could not be run @throws Cancelled
int run_program(const Strings& words, const fs::path& output, const Context& context) {
  std::vector<char*> arguments;
  for (const std::string& w : words) arguments.push_back(const_cast<char*>(w.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error) return -1;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (context.cancelled()) {
      kill(child, SIGTERM);
      waitpid(child, &status, 0);
      throw Cancelled();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// @return why there are no plots; empty = there are
std::string draw(const fs::path& folder, const Context& context) {
  constexpr int kNoMatplotlib = 3;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path script = program.parent_path().parent_path() / "share" / "ga_symmetry" / "comparison_plots.py";
  if (error || !fs::exists(script)) return "no plots: " + script.string() + " is missing, install the program again";
  const fs::path log = folder / "plots.log";
  int status = -1;
  for (const char* python : {"python3", "/usr/bin/python3"}) {  // the first may be one without the system's packages
    status = run_program({python, script.string(), folder.string()}, log, context);
    if (status >= 0 && status != kNoMatplotlib && status != 127) break;
  }
  if (status == 0) return "";
  if (status == kNoMatplotlib || status < 0 || status == 127)
    return "no plots: install python3-matplotlib (apt-get install python3-matplotlib) and run this again";
  std::ifstream in(log);
  std::string line, last;
  while (std::getline(in, line)) last = line;
  return "no plots: comparison_plots.py failed: " + last;
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

std::vector<std::string> write_report(const std::string& folder, const Comparison& comparison, const Context& context) {
  PendingFolder pending(without_slash(folder));
  const std::vector<Score> scores = make_scores(comparison);
  write_tables(pending.path(), comparison, scores);
  write_pictures(pending.path(), comparison);
  Strings messages;
  if (const std::string why = draw(pending.path(), context); !why.empty()) messages.push_back(why);
  write_file((pending.path() / "report.html").string(), make_page(pending.path(), comparison, scores, messages));
  for (const auto& entry : fs::directory_iterator(pending.path()))
    if (const auto ending = entry.path().extension(); ending != ".csv" && ending != ".html") fs::remove(entry.path());
  pending.commit();
  return messages;
}

}  // namespace ga_symmetry::tool
