// SPDX-License-Identifier: GPL-3.0-or-later
// A filter that fails or is stopped leaves the document byte for byte as it was, and no file.
#include <gtest/gtest.h>
#include <unistd.h>

#include <QCoreApplication>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "filter_ga_symmetry.h"
#include "filters.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/mesh.h"

namespace {

namespace fs = std::filesystem;

const std::string kSamples = GA_SYMMETRY_SAMPLE_MESHES;
const char* const kReferences = "0,1,2:3";  // valid indices; that they make no sense is not the matter here

// Asked from here, because MeshLab's callback is a plain function.
std::function<bool(int percent, const char* stage)> answer;
bool callback(const int percent, const char* stage) { return answer(percent, stage); }

template <class Value>
void append(std::string& out, const Value& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// All that a user can see or save of the document.
std::string bytes(MeshDocument& document) {
  std::string out = std::to_string(document.meshList.size()) + " layers, current " +
                    std::to_string(document.meshList.indexOf(document.mm()));
  for (MeshModel* layer : document.meshList) {
    CMeshO& m = layer->cm;
    out += layer->label().toStdString();
    append(out, layer->dataMask());
    append(out, m.vn), append(out, m.fn), append(out, m.vert.size()), append(out, m.face.size()), append(out, m.Tr),
        append(out, m.bbox);
    for (CVertexO& v : m.vert) {
      append(out, v.P()), append(out, v.N()), append(out, v.Q()), append(out, v.C()), append(out, v.Flags());
    }
    for (CFaceO& f : m.face) {
      for (int k = 0; k < 3; ++k) append(out, vcg::tri::Index(m, f.V(k)));
      append(out, f.N()), append(out, f.Flags());
    }
    for (const auto& attribute : m.vert_attr) {
      out += attribute._name;
      const std::size_t size = m.vert.size() * attribute._handle->SizeOf();
      if (size > 0) out.append(static_cast<const char*>(attribute._handle->DataBegin()), size);
    }
  }
  return out;
}

class Unchanged : public testing::Test {
 protected:
  Unchanged() { fs::create_directories(folder_); }
  ~Unchanged() override { fs::remove_all(folder_); }

  // A sample with quality, colours, a selection and an attribute of the user's own.
  MeshModel* open(int copies = 1) {
    const ga_symmetry::TriangleMesh mesh = ga_symmetry::read_mesh(kSamples + "/person_wave.off");
    MeshModel* layer = document_.addNewMesh("", "layer");
    CMeshO& m = layer->cm;
    for (int copy = 0; copy < copies; ++copy) {
      const int first = static_cast<int>(m.vert.size());
      auto vertex = vcg::tri::Allocator<CMeshO>::AddVertices(m, mesh.vertices());
      for (int v = 0; v < mesh.vertices(); ++v, ++vertex) {
        vertex->P() = {static_cast<float>(mesh.position[3 * v] + 10 * copy),
                       static_cast<float>(mesh.position[3 * v + 1]), static_cast<float>(mesh.position[3 * v + 2])};
        vertex->Q() = static_cast<float>(v % 7);
        vertex->C() = vcg::Color4b(v % 256, v % 11, v % 3, 255);
        if (v % 5 == 0) vertex->SetS();
      }
      for (std::size_t c = 0; c < mesh.triangle.size(); c += 3)
        vcg::tri::Allocator<CMeshO>::AddFace(m, first + mesh.triangle[c], first + mesh.triangle[c + 1],
                                             first + mesh.triangle[c + 2]);
    }
    auto weight = vcg::tri::Allocator<CMeshO>::AddPerVertexAttribute<float>(m, "weight");
    for (std::size_t v = 0; v < m.vert.size(); ++v) weight[v] = static_cast<float>(v) / 3;
    vcg::tri::UpdateBounding<CMeshO>::Box(m);
    vcg::tri::UpdateNormal<CMeshO>::PerVertexNormalizedPerFaceNormalized(m);
    return layer;
  }

  // Without compaction.
  static void delete_first_copy(CMeshO& m) {
    for (std::size_t f = 0; f < m.face.size() / 2; ++f) vcg::tri::Allocator<CMeshO>::DeleteFace(m, m.face[f]);
    for (std::size_t v = 0; v < m.vert.size() / 2; ++v) vcg::tri::Allocator<CMeshO>::DeleteVertex(m, m.vert[v]);
  }

  using Settings = std::vector<std::pair<const char*, std::string>>;

  // As MeshLab applies the filter of that name.
  bool apply(const std::string& name, const Settings& settings) {
    const auto& all = ga_symmetry::all_filters();
    const auto at = std::find_if(all.begin(), all.end(), [&](const auto& f) { return f.python_name == name; });
    QAction* action = filters_.actions().at(static_cast<int>(at - all.begin()));
    RichParameterList list;
    filters_.initParameterSet(action, document_, list);
    for (const auto& [parameter, text] : settings) {
      const QString value = QString::fromStdString(text);
      const Value& kind = list.getParameterByName(parameter).value();
      if (kind.isBool())
        list.setValue(parameter, BoolValue(value == "true"));
      else if (kind.isEnum())
        list.setValue(parameter, EnumValue(value.toInt()));
      else if (kind.isInt())
        list.setValue(parameter, IntValue(value.toInt()));
      else if (kind.isFileName())
        list.setValue(parameter, FileValue(value));
      else
        list.setValue(parameter, StringValue(value));
    }
    return filters_.applyFilter(action, document_, list, callback);
  }

  Settings quick(Settings more) const {
    Settings out{{"joint_samples", "30"},
                 {"proxy", "1000"},
                 {"advanced", "joint_sites=60 joint_population=10 pairs_samples=60 pairs_generations=5"}};
    out.push_back({"export_to", (folder_ / "partners.json").string()});
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }

  // Stopped once at the first report of every stage; in the end the filter may finish, and then shows what it does.
  void stop_at_every_stage(const std::string& name, const Settings& settings, bool exports = false) {
    const std::string before = bytes(document_);
    std::vector<std::string> stages;
    bool stopped = false;
    answer = [&](int, const char* stage) {
      EXPECT_FALSE(stopped) << name << " goes on at " << stage;
      if (std::find(stages.begin(), stages.end(), stage) != stages.end()) return true;
      stages.push_back(stage);
      stopped = true;
      return false;
    };
    for (; !apply(name, settings); stopped = false) {
      ASSERT_FALSE(stages.empty()) << filters_.errorMsg().toStdString();
      EXPECT_EQ(filters_.errorMsg(), "cancelled") << stages.back();
      EXPECT_TRUE(bytes(document_) == before) << name << " stopped at " << stages.back();
      EXPECT_TRUE(fs::is_empty(folder_)) << name << " stopped at " << stages.back();
    }
    EXPECT_FALSE(stopped) << name << " finishes though it was stopped at " << stages.back();
    EXPECT_FALSE(stages.empty()) << name << " cannot be stopped";
    EXPECT_FALSE(bytes(document_) == before) << name << " changes nothing, so that nothing is tested";
    EXPECT_EQ(fs::is_empty(folder_), !exports);
  }

  void expect_failure(const std::string& name, const Settings& settings) {
    answer = [](int, const char*) { return true; };
    const std::string before = bytes(document_);
    EXPECT_FALSE(apply(name, settings));
    EXPECT_NE(filters_.errorMsg(), "") << name;
    EXPECT_TRUE(bytes(document_) == before) << name << ": " << filters_.errorMsg().toStdString();
    EXPECT_TRUE(fs::is_empty(folder_)) << name;
  }

  fs::path folder_ = fs::temp_directory_path() / ("ga_symmetry_unchanged_" + std::to_string(::getpid()));
  MeshDocument document_;
  FilterGaSymmetry filters_;
};

constexpr const char* kFind = "compute_intrinsic_symmetry_per_vertex";

TEST_F(Unchanged, StoppedWhileItSearches) {
  open();
  stop_at_every_stage(kFind, quick({{"references", kReferences}}), true);
}

TEST_F(Unchanged, StoppedWhileItSearchesPairByPair) {
  open();
  stop_at_every_stage(kFind, quick({{"references", kReferences}, {"method", "1"}}), true);
}

TEST_F(Unchanged, StoppedWithOlderPartnersThere) {
  open();
  answer = [](int, const char*) { return true; };
  ASSERT_TRUE(apply(kFind, quick({{"references", kReferences}}))) << filters_.errorMsg().toStdString();
  fs::remove(folder_ / "partners.json");
  stop_at_every_stage(kFind, quick({{"references", "3,7,2:9"}}), true);
  fs::remove(folder_ / "partners.json");
  stop_at_every_stage("compute_asymmetry_per_vertex", {});
  stop_at_every_stage("generate_evenly_spaced_samples", {});
}

TEST_F(Unchanged, Failed) {
  open();
  expect_failure(kFind, quick({{"references", "0,1,2:99999999"}}));
  expect_failure(kFind, quick({{"joint_samples", "-1"}}));
  expect_failure(kFind, quick({{"advanced", "joint_sites=many"}}));
  expect_failure(kFind, quick({{"references", kReferences}, {"export_to", (folder_ / "no/partners.csv").string()}}));
  expect_failure(kFind, quick({{"references", kReferences}, {"export_to", (folder_ / "partners.xyz").string()}}));
  expect_failure("load_partners_of_intrinsic_symmetry", {{"partners_file", kSamples + "/person_wave.truth"}});
  for (const char* name : {"generate_polyline_from_intrinsic_symmetry", "transfer_attributes_across_intrinsic_symmetry",
                           "compute_asymmetry_per_vertex"})
    expect_failure(name, {});
  expect_failure("generate_evenly_spaced_samples", {{"samples", "0"}});
}

TEST_F(Unchanged, OfSeveralComponents) {
  open(2);
  expect_failure(kFind, quick({{"references", "0,1,2:99999999"}}));
  expect_failure("generate_evenly_spaced_samples", {{"samples", "0"}});
}

TEST_F(Unchanged, WithDeletedVertices) {
  delete_first_copy(open(2)->cm);
  expect_failure(kFind, quick({{"references", "0,1,2:99999999"}}));
  expect_failure(kFind, quick({{"references", "0,1,1:1"}}));
  expect_failure("load_partners_of_intrinsic_symmetry", {{"partners_file", kSamples + "/person_wave.truth"}});
  for (const char* name : {"generate_polyline_from_intrinsic_symmetry", "transfer_attributes_across_intrinsic_symmetry",
                           "compute_asymmetry_per_vertex"})
    expect_failure(name, {});
  expect_failure("generate_evenly_spaced_samples", {{"samples", "0"}});
  stop_at_every_stage(kFind, quick({{"references", kReferences}}), true);
}

// With deleted vertices filters do what they do without them.
TEST_F(Unchanged, DeletedVerticesMakeNoDifference) {
  answer = [](int, const char*) { return true; };
  std::ifstream file(kSamples + "/person_wave.refs");
  const std::vector<int> references(std::istream_iterator<int>(file), {});
  ASSERT_EQ(references.size(), 4u);
  std::string after[2];
  for (const bool compacted : {false, true}) {
    MeshModel* layer = open(2);
    CMeshO& m = layer->cm;
    delete_first_copy(m);
    for (CVertexO& v : m.vert) v.ClearS();
    for (const int v : references) m.vert[m.vert.size() / 2 + v].SetS();
    for (const char* name : {kFind, "transfer_attributes_across_intrinsic_symmetry", "compute_asymmetry_per_vertex",
                             "generate_polyline_from_intrinsic_symmetry", "generate_evenly_spaced_samples"}) {
      if (compacted) vcg::tri::Allocator<CMeshO>::CompactEveryVector(m);
      ASSERT_TRUE(apply(name, name == kFind ? quick({}) : Settings{})) << filters_.errorMsg().toStdString();
      EXPECT_EQ(m.vert.size(), static_cast<std::size_t>(m.vn)) << name;
      // At the end, so that the others keep their numbers.
      const auto added = vcg::tri::Allocator<CMeshO>::AddVertices(m, 5) - m.vert.begin();
      for (int k = 0; k < 5; ++k) vcg::tri::Allocator<CMeshO>::DeleteVertex(m, m.vert[added + k]);
    }
    vcg::tri::Allocator<CMeshO>::CompactEveryVector(m);
    after[compacted] = bytes(document_);
    while (!document_.meshList.isEmpty()) document_.delMesh(document_.meshList.front());
  }
  EXPECT_TRUE(after[0] == after[1]);
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  QCoreApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
