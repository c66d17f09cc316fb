#include "read/mesh_file.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <tinyxml2.h>

#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include "description/sentence.hpp"
#include "description/validate.hpp"
#include "read/collada_check.hpp"
#include "read/xml_element.hpp"

namespace Assimp {

/// In place of the library's own, which ends the program at a file that is not as it expects.
void aiAssertViolation(const char* expected, const char* /*source*/, int /*line*/) {
  throw std::runtime_error("not as expected: " + std::string(expected));
}

}  // namespace Assimp

namespace navvi_sim::read {
namespace {

constexpr std::uintmax_t kMaxBytes = 200'000'000;
constexpr std::size_t kMaxTriangles = 1'000'000;  // assimp takes 0.5 kB for each
constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
constexpr int kMaxDepth = 200;               // of nodes
constexpr float kLeastExtent = 1e-3F;        // m
constexpr std::size_t kNamed = 10;           // parts in a sentence
constexpr std::uintmax_t kStlHead = 84;      // bytes of a binary .stl before its triangles
constexpr std::uintmax_t kStlTriangle = 50;  // bytes

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw WorldError("the mesh '" + file.string() + "' " + what);
}

/// Opens the mesh alone: the materials and pictures that it names may be any file, and a pipe among
/// them would never end.
class MeshAlone : public Assimp::DefaultIOSystem {
 public:
  explicit MeshAlone(std::string file) : file_(std::move(file)) {}
  bool Exists(const char* file) const override { return file == file_; }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return file == file_ ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  std::string file_;
};

/// \returns its extension in lower case
std::string check_file(const std::filesystem::path& file) {
  std::string extension = lower_case(file.extension().string());
  if (extension != ".dae" && extension != ".stl" && extension != ".obj")
    refuse(file, "is of a kind that is not read; allowed are .dae, .stl and .obj files");
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    refuse(file, "does not exist or is not a file; allowed are .dae, .stl and .obj files");
  if (std::filesystem::file_size(file, error) > kMaxBytes || error)
    refuse(file, "is larger than 200 MB or cannot be read; allowed is up to 200 MB");
  const std::string pointer = "version https://git-lfs";
  std::string first(pointer.size(), '\0');
  std::ifstream(file).read(first.data(), static_cast<std::streamsize>(first.size()));
  if (first == pointer)
    refuse(file, "is a pointer of Git LFS and not the file itself; git lfs pull fetches it");
  return extension;
}

[[noreturn]] void refuse_size(const std::filesystem::path& file) {
  refuse(file,
         "has more than " + std::to_string(kMaxTriangles) + " triangles; allowed is up to that");
}

/// Refuses a large binary .stl, whose size is that of its triangles, before it takes memory.
void check_stl(const std::filesystem::path& file) {
  std::array<unsigned char, kStlHead> head{};
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(head.data()), kStlHead)) return;
  const std::uintmax_t count =
      head[80] | head[81] << 8 | head[82] << 16 | static_cast<std::uintmax_t>(head[83]) << 24;
  if (count > kMaxTriangles && std::filesystem::file_size(file) == kStlHead + kStlTriangle * count)
    refuse_size(file);
}

/// Refuses a face of so many corners that it takes long to cut into triangles.
void check_obj(const std::filesystem::path& file) {
  constexpr std::size_t kMostCorners = 5'000;  // twice as many take four times as long
  std::ifstream stream(file, std::ios::binary);
  bool goes_on = false;
  std::size_t corners = 0;
  for (std::string line; std::getline(stream, line);
       goes_on = !line.empty() && line.back() == '\\') {
    while (!line.empty() && line.back() == '\r') line.pop_back();
    const std::size_t begin = line.find_first_not_of(" \t");
    if (!goes_on) corners = 0;
    if (begin == std::string::npos || (!goes_on && line[begin] != 'f')) continue;
    for (std::size_t at = line.find_first_of(" \t", begin); at < line.size();
         at = line.find_first_of(" \t", at)) {
      at = line.find_first_not_of(" \t", at);
      if (at < line.size() && ++corners > kMostCorners)
        refuse(file, "has a face of more than " + std::to_string(kMostCorners) +
                         " corners; allowed is up to that");
    }
  }
}

/// Prints Collada without what assimp's reader trips over and Gazebo's own does not: comments,
/// document types, and, of a document that collapses them, blanks before the first word of an
/// element.
class PlainPrinter : public tinyxml2::XMLPrinter {
 public:
  PlainPrinter() : XMLPrinter(nullptr, true) {}
  using XMLPrinter::Visit;
  bool Visit(const tinyxml2::XMLComment&) override { return true; }
  bool Visit(const tinyxml2::XMLUnknown&) override { return true; }
};

/// \throws WorldError for a text that assimp must not read
std::string plain_collada(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  tinyxml2::XMLDocument document(true, tinyxml2::COLLAPSE_WHITESPACE);
  parse_xml(file, std::string((std::istreambuf_iterator<char>(stream)), {}), document);
  PlainPrinter plain;
  document.Print(&plain);
  std::string text = plain.CStr();
  check_collada(file, *document.RootElement(), text.size());
  return text;
}

Eigen::Matrix4d matrix(const aiMatrix4x4& m) {
  return Eigen::Map<const Eigen::Matrix<ai_real, 4, 4, Eigen::RowMajor>>(m[0]).cast<double>();
}

/// Refuses corners that are no numbers, which assimp would join with others.
void check_numbers(const aiScene& scene, const std::filesystem::path& file) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& piece = *scene.mMeshes[i];
    for (unsigned k = 0; k < piece.mNumVertices; ++k)
      if (const aiVector3D& v = piece.mVertices[k]; !std::isfinite(v.x + v.y + v.z))
        refuse(file, "has a corner that is not of three numbers; allowed are finite ones");
  }
}

/// Gathers the triangles of a scene, or of its parts of one name.
class MeshBuilder {
 public:
  MeshBuilder(const aiScene& scene, const std::filesystem::path& file, const MeshPart& part)
      : scene_(scene), file_(file), part_(part) {}

  [[nodiscard]] Mesh build() {
    if (scene_.mRootNode != nullptr)
      visit(*scene_.mRootNode, Eigen::Matrix4d::Identity(), part_.name.empty(), 0);
    if (mesh_.triangles.empty() && !part_.name.empty())
      refuse(file_, "has no part '" + part_.name + "' with triangles; it has " + names());
    if (mesh_.triangles.empty()) refuse(file_, "has no triangles; allowed are one or more");
    place();
    return std::move(mesh_);
  }

 private:
  void visit(const aiNode& node, const Eigen::Matrix4d& parent, bool wanted, int depth) {
    if (depth > kMaxDepth)
      refuse(file_, "has nodes nested more than " + std::to_string(kMaxDepth) + " deep");
    const Eigen::Matrix4d pose = parent * matrix(node.mTransformation);
    names_.insert(node.mName.C_Str());
    const bool all = wanted || node.mName.C_Str() == part_.name;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) refuse(file_, "has a node without its mesh");
      const aiMesh& piece = *scene_.mMeshes[node.mMeshes[i]];
      names_.insert(piece.mName.C_Str());
      if (all || piece.mName.C_Str() == part_.name) append(piece, pose);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
      visit(*node.mChildren[i], pose, all, depth + 1);
  }

  void append(const aiMesh& piece, const Eigen::Matrix4d& pose) {
    // Lines and points have no surface: what only they use must not count for the thing's size.
    std::vector<std::uint32_t> index(piece.mNumVertices, kUnused);
    for (unsigned i = 0; i < piece.mNumFaces; ++i) {
      const aiFace& face = piece.mFaces[i];
      for (unsigned k = 0; face.mNumIndices == 3 && k < 3; ++k) {
        if (face.mIndices[k] >= piece.mNumVertices)
          refuse(file_, "has a triangle with vertex " + std::to_string(face.mIndices[k]) +
                            "; there are " + std::to_string(piece.mNumVertices));
        index[face.mIndices[k]] = 0;
      }
    }
    for (unsigned i = 0; i < piece.mNumVertices; ++i) {
      if (index[i] == kUnused) continue;
      index[i] = static_cast<std::uint32_t>(mesh_.vertices.size());
      const aiVector3D& v = piece.mVertices[i];
      const Eigen::Vector4d at(static_cast<double>(v.x), static_cast<double>(v.y),
                               static_cast<double>(v.z), 1.0);
      mesh_.vertices.push_back((pose * at).head<3>().cwiseProduct(part_.scale).cast<float>());
      const Eigen::Vector3f& vertex = mesh_.vertices.back();
      if (!(vertex.cwiseAbs().maxCoeff() <= static_cast<float>(WorldLimits::extent)))
        refuse(file_, "has a vertex at " + text(static_cast<double>(vertex.x())) + ", " +
                          text(static_cast<double>(vertex.y())) + ", " +
                          text(static_cast<double>(vertex.z())) + "; allowed are -1000 to 1000 m");
    }
    for (unsigned i = 0; i < piece.mNumFaces; ++i) {
      const aiFace& face = piece.mFaces[i];
      if (face.mNumIndices == 3)
        mesh_.triangles.push_back(
            {index[face.mIndices[0]], index[face.mIndices[1]], index[face.mIndices[2]]});
    }
    if (mesh_.triangles.size() > kMaxTriangles) refuse_size(file_);
  }

  void place() {
    Eigen::AlignedBox3f bounds;
    for (const Eigen::Vector3f& vertex : mesh_.vertices) bounds.extend(vertex);
    if (bounds.sizes().maxCoeff() < kLeastExtent)
      refuse(file_, "is less than 1 mm long, wide and high; its unit, scale or nodes may be wrong");
    if (!part_.centred) return;
    const Eigen::Vector3f centre = bounds.center();
    for (Eigen::Vector3f& vertex : mesh_.vertices) vertex -= centre;
  }

  [[nodiscard]] std::string names() const {
    std::string list;
    std::size_t count = 0;
    for (const std::string& name : names_) {
      if (name.empty()) continue;
      if (++count > kNamed) return list + ", ...";
      list += (list.empty() ? "'" : ", '") + name + "'";
    }
    return list.empty() ? "no names" : list;
  }

  const aiScene& scene_;
  const std::filesystem::path& file_;
  const MeshPart& part_;
  Mesh mesh_;
  std::set<std::string> names_;
};

}  // namespace

Mesh read_mesh(const std::filesystem::path& file, const MeshPart& part) {
  if (!part.scale.allFinite() || (part.scale.array() == 0.0).any())
    refuse(file, "has a scale that is zero or not finite; allowed are other numbers");
  const std::string extension = check_file(file);
  if (extension == ".stl") check_stl(file);
  if (extension == ".obj") check_obj(file);
  Assimp::Importer importer;
  importer.SetIOHandler(new MeshAlone(file.string()));  // the importer's from now on
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);  // as Gazebo does
  const aiScene* scene = nullptr;
  std::string reason;
  try {
    if (extension == ".dae") {
      const std::string plain = plain_collada(file);
      scene = importer.ReadFileFromMemory(plain.data(), plain.size(), aiProcess_Triangulate, "dae");
    } else {
      scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
    }
    if (scene != nullptr) {
      check_numbers(*scene, file);
      scene = importer.ApplyPostProcessing(aiProcess_JoinIdenticalVertices);
    }
    reason = importer.GetErrorString();
  } catch (const WorldError&) {
    throw;
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (scene == nullptr)
    refuse(file, "cannot be read (" + reason + "); allowed are whole .dae, .stl and .obj files");
  return MeshBuilder(*scene, file, part).build();
}

}  // namespace navvi_sim::read
