#include "surefoot/simulation/mesh_hulls.hpp"

#include "surefoot/math/types.hpp"

namespace surefoot::simulation {
namespace {

/// The hull's vertices in the file's frame, scaled; the compiled mesh is in its principal axes.
std::vector<float> hull(const mjModel& model, int mesh) {
  std::vector<float> result;
  const double* q = model.mesh_quat + 4 * mesh;
  const Quat R(q[0], q[1], q[2], q[3]);
  const Vec3 p(model.mesh_pos + 3 * mesh);
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  // A graph starts with its counts of vertices and faces; the vertex numbers come second.
  const int* graph = model.mesh_graph + model.mesh_graphadr[mesh];
  const int count = graph[0];
  for (int i = 0; i < count; ++i) {
    const float* v = vertices + 3 * graph[2 + count + i];
    const Vec3 vertex = p + R * Vec3(v[0], v[1], v[2]);
    for (const double value : vertex) result.push_back(static_cast<float>(value));
  }
  return result;
}

}  // namespace

void embed_hulls(mjSpec& spec, const mjModel& compiled) {
  for (mjsElement* element = mjs_firstElement(&spec, mjOBJ_MESH); element != nullptr;
       element = mjs_nextElement(&spec, element)) {
    mjsMesh& mesh = *mjs_asMesh(element);
    const std::vector<float> vertices =
        hull(compiled, id_of(compiled, mjOBJ_MESH, name_of(element)));
    mjs_setString(mesh.file, "");
    mjs_setString(mesh.content_type, "");
    mjs_setFloat(mesh.uservert, vertices.data(), static_cast<int>(vertices.size()));
    for (double& scale : mesh.scale) scale = 1.0;
  }
}

}  // namespace surefoot::simulation
