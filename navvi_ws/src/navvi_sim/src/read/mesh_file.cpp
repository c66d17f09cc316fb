#include "read/mesh_file.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/resource.h>
#include <tinyxml2.h>
#include <unistd.h>

#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <navvi_files/bytes.hpp>
#include <navvi_files/child_process.hpp>
#include <set>
#include <string_view>

#include "description/sentence.hpp"
#include "description/validate.hpp"
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
constexpr rlim_t kMostMemory = rlim_t{2} << 30U;  // bytes, of reading one
constexpr rlim_t kMostSeconds = 20;  // of the processor, of reading one
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

/// Refuses a word among indices, which assimp reads until no memory is left, and an array that is
/// shorter than what its accessor names, beyond which it reads.
void check_collada(const std::filesystem::path& file, const tinyxml2::XMLElement& element) {
  const std::string_view name = element.Name();
  const bool indices = name == "p" || name == "v" || name == "h" || name == "vcount";
  for (const auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling()) {
    if (child->ToElement() != nullptr) check_collada(file, *child->ToElement());
    if (indices && child->ToText() != nullptr &&
        child->Value()[std::strspn(child->Value(), "0123456789+- \t\r\n")] != '\0')
      refuse(file, "has a <" + std::string(name) +
                       "> that holds more than indices; allowed are whole numbers");
  }
  const auto* const technique = element.FirstChildElement("technique_common");
  const auto* const accessor =
      technique == nullptr ? nullptr : technique->FirstChildElement("accessor");
  const auto* const array = element.FirstChildElement("float_array");
  if (accessor == nullptr || array == nullptr) return;
  const double stride = accessor->DoubleAttribute("stride", 1.0);
  const double needed =
      accessor->DoubleAttribute("offset") + accessor->DoubleAttribute("count") * stride;
  if (needed > array->DoubleAttribute("count"))
    refuse(file, "has a <float_array> with a smaller count than its <accessor> reads");
}

/// \throws WorldError for a text that assimp must not read
std::string plain_collada(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  tinyxml2::XMLDocument document(true, tinyxml2::COLLAPSE_WHITESPACE);
  parse_xml(file, std::string((std::istreambuf_iterator<char>(stream)), {}), document);
  check_collada(file, *document.RootElement());
  PlainPrinter plain;
  document.Print(&plain);
  return plain.CStr();
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

/// By assimp, which a hostile file may make crash, or take all memory or time.
Mesh import(const std::filesystem::path& file, const std::string& extension, const MeshPart& part) {
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

/// Of this process, which only reads a mesh.
void limit_resources() {
  const rlimit seconds{kMostSeconds, kMostSeconds};
  ::setrlimit(RLIMIT_CPU, &seconds);
  std::ifstream now("/proc/self/statm");
  rlim_t pages = 0;  // the last that is read: those that can be written
  for (int i = 0; i < 6; ++i) now >> pages;
  const rlim_t bytes = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + kMostMemory;
  const rlimit memory{bytes, bytes};
  ::setrlimit(RLIMIT_DATA, &memory);
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& file, const MeshPart& part) {
  if (!part.scale.allFinite() || (part.scale.array() == 0.0).any())
    refuse(file, "has a scale that is zero or not finite; allowed are other numbers");
  const std::string extension = check_file(file);
  if (extension == ".stl") check_stl(file);
  const navvi_files::Answer answer = navvi_files::run_in_child(
      [&] {
        limit_resources();
        const Mesh mesh = import(file, extension, part);
        std::vector<float> numbers(3 * mesh.vertices.size());
        for (std::size_t i = 0; i < numbers.size(); ++i)
          numbers[i] = mesh.vertices[i / 3][static_cast<Eigen::Index>(i % 3)];
        navvi_files::ByteWriter writer;
        writer.put(numbers, mesh.triangles);
        return writer.bytes();
      },
      "the mesh '" + file.string() + "' cannot be read: its reader crashed, or took more than " +
          std::to_string(kMostMemory >> 30U) + " GB or " + std::to_string(kMostSeconds) + " s");
  if (!answer.good) throw WorldError(answer.text);
  Mesh mesh;
  std::vector<float> numbers;
  navvi_files::ByteReader(answer.text).get(numbers, mesh.triangles);
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    mesh.vertices.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return mesh;
}

}  // namespace navvi_sim::read
