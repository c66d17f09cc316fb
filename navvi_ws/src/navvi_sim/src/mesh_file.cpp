#include "navvi_sim/mesh_file.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "navvi_sim/validate.hpp"

namespace navvi_sim {
namespace {

constexpr std::uintmax_t kMaxBytes = 200'000'000;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw WorldError("the mesh " + file.string() + " " + what);
}

void check_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    refuse(file, "does not exist or is no file; allowed are .dae, .stl and .obj files");
  if (std::filesystem::file_size(file, error) > kMaxBytes || error)
    refuse(file, "is larger than 200 MB or cannot be read; allowed is up to 200 MB");
}

void append(Mesh& mesh, const aiMesh& part, const Eigen::Vector3d& scale) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    const Eigen::Vector3d p(static_cast<double>(v.x), static_cast<double>(v.y),
                            static_cast<double>(v.z));
    mesh.vertices.push_back(p.cwiseProduct(scale).cast<float>());
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // lines and points have no surface
    mesh.triangles.push_back(
        {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& file, const Eigen::Vector3d& scale) {
  if (!scale.allFinite() || (scale.array() == 0.0).any())
    refuse(file, "has a scale that is zero or not finite; allowed are other numbers");
  check_file(file);
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);  // as Gazebo does
  const aiScene* scene = nullptr;
  std::string reason;
  try {
    scene =
        importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                             aiProcess_PreTransformVertices);
    reason = importer.GetErrorString();
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (scene == nullptr)
    refuse(file, "cannot be read (" + reason + "); allowed are whole .dae, .stl and .obj files");
  Mesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(mesh, *scene->mMeshes[i], scale);
  if (mesh.triangles.empty()) refuse(file, "has no triangles; allowed are one or more");
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    if (!vertex.allFinite()) refuse(file, "has a vertex that is not finite");
  return mesh;
}

}  // namespace navvi_sim
