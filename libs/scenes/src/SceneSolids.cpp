// SPDX-License-Identifier: BSD-3-Clause
#include "SceneSolids.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/simulation/MeshFile.h"
#include "hoctomap/simulation/Shape.h"

namespace hoctomap {
namespace {

/// A section [solid.NAME], before the names in it are resolved.
struct SolidSection {
  std::string section;
  Solid solid;
  TriangleMesh surface;
  std::string on;
  std::string part_of;
  std::optional<double> top;
};

BoxShape readBox(IniDocument& ini, const std::string& section) {
  const auto size = ini.numbers(section, "size", {0.1, 0.1, 0.1}, 3, kPositive);
  return {{size[0], size[1], size[2]}};
}

CylinderShape readCylinder(IniDocument& ini, const std::string& section) {
  const CylinderShape fallback;
  return {ini.number(section, "radius", fallback.radius, kPositive),
          ini.number(section, "height", fallback.height, kPositive)};
}

SphereShape readSphere(IniDocument& ini, const std::string& section) {
  return {ini.number(section, "radius", SphereShape{}.radius, kPositive)};
}

TurnedShape readTurned(IniDocument& ini, const std::string& section) {
  TurnedShape shape;
  const std::vector<double> cylinder{0.04, 0.0, 0.04, 0.1};
  const auto numbers = ini.numbers(section, "profile", cylinder, std::nullopt, kAnyNumber);
  if (numbers.size() % 2 != 0) ini.problem(section, "profile", "needs pairs of radius and z");
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
    shape.profile.emplace_back(numbers[i], numbers[i + 1]);
  shape.wall = ini.number(section, "wall", 0.0, kNotNegative);
  if (const auto handle = ini.numbers(section, "handle", {0, 0, 0, 0}, 4, kNotNegative);
      ini.has(section, "handle"))
    shape.handle = Handle{handle[0], handle[1], handle[2], handle[3]};
  return shape;
}

TableShape readTable(IniDocument& ini, const std::string& section) {
  const TableShape fallback;
  TableShape table;
  const auto size = ini.numbers(section, "size", {fallback.size.x(), fallback.size.y()}, 2, kPositive);
  table.size = {size[0], size[1]};
  table.height = ini.number(section, "height", fallback.height, kPositive);
  table.thickness = ini.number(section, "thickness", fallback.thickness, kPositive);
  table.leg = ini.number(section, "leg", fallback.leg, kPositive);
  return table;
}

TriangleMesh readMesh(IniDocument& ini, const std::string& section, const std::filesystem::path& folder) {
  const std::string file = ini.text(section, "file", "");
  if (file.empty()) {
    ini.problem(section, "file", "a mesh needs a file");
    return {};
  }
  return loadMesh(folder / file, 1.0);
}

TriangleMesh readSurface(IniDocument& ini, const std::string& section, const std::filesystem::path& folder) {
  const std::vector<std::string> shapes{"box", "cylinder", "sphere", "turned", "table", "mesh"};
  const std::string shape = ini.choice(section, "shape", "box", shapes);
  if (shape == "cylinder") return tessellate(readCylinder(ini, section));
  if (shape == "sphere") return tessellate(readSphere(ini, section));
  if (shape == "turned") return tessellate(readTurned(ini, section));
  if (shape == "table") return tessellate(readTable(ini, section));
  if (shape == "mesh") return readMesh(ini, section, folder);
  return tessellate(readBox(ini, section));
}

/// The surface, or nothing after noting why there is none.
TriangleMesh readScaledSurface(IniDocument& ini, const std::string& section,
                               const std::filesystem::path& folder) {
  const double scale = ini.number(section, "scale", 1.0, kPositive);
  TriangleMesh surface;
  try {
    surface = readSurface(ini, section, folder);
  } catch (const ConfigError& error) {
    ini.problem(section, "", error.what());
  } catch (const InputError& error) {
    ini.problem(section, "file", error.what());
  }
  if (scale != 1.0)
    for (auto& vertex : surface.vertices) vertex = (scale * vertex.cast<double>()).cast<float>();
  return surface;
}

SolidLabel readLabel(IniDocument& ini, const std::string& section) {
  const std::string label = ini.choice(section, "label", "object", {"background", "table", "object"});
  if (label == "background") return SolidLabel::background;
  return label == "table" ? SolidLabel::table : SolidLabel::object;
}

SolidSection readSection(IniDocument& ini, const std::string& section, const std::filesystem::path& folder) {
  SolidSection read;
  read.section = section;
  read.solid.name = nameAfter("solid.", section);
  read.surface = readScaledSurface(ini, section, folder);
  const Eigen::Vector3d p = readVector(ini, section, "position", Eigen::Vector3d::Zero());
  const Eigen::Vector3d a = kDegree * readVector(ini, section, "orientation", Eigen::Vector3d::Zero());
  read.solid.support_T_solid = Pose(p.x(), p.y(), p.z(), a.x(), a.y(), a.z());
  read.part_of = ini.text(section, "part_of", "");
  if (!read.part_of.empty()) return read;  // the rest is said by the whole

  read.solid.label = readLabel(ini, section);
  read.on = ini.text(section, "on", "world");
  read.solid.present = ini.boolean(section, "present", true);
  if (const double top = ini.number(section, "top", 0.0, kAnyNumber); ini.has(section, "top")) read.top = top;
  return read;
}

void joinParts(IniDocument& ini, std::vector<SolidSection>& sections) {
  for (const SolidSection& part : sections) {
    if (part.part_of.empty()) continue;
    const auto whole = std::find_if(sections.begin(), sections.end(), [&](const SolidSection& s) {
      return s.solid.name == part.part_of && s.part_of.empty();
    });
    if (whole == sections.end())
      ini.problem(part.section, "part_of", "there is no solid '" + part.part_of + "' that is a whole");
    else
      whole->surface.append(part.surface, toIsometry(part.solid.support_T_solid));
  }
}

void addSolid(IniDocument& ini, Scene& scene, SolidSection& read) {
  // Noted already; a stand-in keeps what refers to this solid from failing too.
  if (read.surface.triangles.empty()) read.surface = tessellate(BoxShape{});
  if (read.on != "world") {
    read.solid.support = scene.find(read.on);
    if (!read.solid.support)
      return ini.problem(read.section, "on", "there is no solid '" + read.on + "' before this one");
  }
  const SurfaceExtent extent = surfaceExtent(read.surface, Eigen::Isometry3d::Identity());
  read.solid.top = read.top.value_or(extent.box.max().z());
  read.solid.surface = std::make_shared<const TriangleMesh>(std::move(read.surface));
  try {
    scene.add(std::move(read.solid));
  } catch (const ConfigError& error) {
    ini.problem(read.section, "", error.what());
  }
}

}  // namespace

std::string nameAfter(std::string_view prefix, const std::string& section) {
  return section.starts_with(prefix) ? section.substr(prefix.size()) : "";
}

Eigen::Vector3d readVector(IniDocument& ini, const std::string& section, const std::string& key,
                           const Eigen::Vector3d& fallback) {
  const auto v = ini.numbers(section, key, {fallback.x(), fallback.y(), fallback.z()}, 3, kAnyNumber);
  return {v[0], v[1], v[2]};
}

Scene readSolids(IniDocument& ini, const std::filesystem::path& mesh_folder) {
  std::vector<SolidSection> sections;
  for (const std::string& section : ini.sections())
    if (!nameAfter("solid.", section).empty()) sections.push_back(readSection(ini, section, mesh_folder));
  if (sections.empty()) ini.problem("", "", "a scene needs at least one section [solid.NAME]");
  joinParts(ini, sections);

  Scene scene;
  for (SolidSection& section : sections)
    if (section.part_of.empty()) addSolid(ini, scene, section);
  return scene;
}

}  // namespace hoctomap
