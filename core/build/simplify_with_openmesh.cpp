#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <array>
#include <cmath>

#include "base/bounds.h"
#include "base/check.h"
#include "build/simplify_mesh.h"

namespace fb {
namespace {

struct MeshTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;
using Decimater = OpenMesh::Decimater::DecimaterT<Mesh>;

// Which input vertex a face shows at each of its places; collapses keep it up to date.
struct FaceCorner {
    OpenMesh::VertexHandle place;
    std::uint32_t vertex = 0;
};
using FaceCorners = std::array<FaceCorner, 3>;

std::uint32_t vertexAt(const FaceCorners& corners, OpenMesh::VertexHandle place) {
    for (const FaceCorner& corner : corners) {
        if (corner.place == place) return corner.vertex;
    }
    return ~std::uint32_t{0};
}

// Quadrics, and on seams and borders also the distance by which the line moves, which the quadrics of flat
// surroundings do not see. Refuses collapses that turn a face over.
class SeamQuadric : public OpenMesh::Decimater::ModQuadricT<Mesh> {
  public:
    using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<Mesh>;

    explicit SeamQuadric(Mesh& mesh) : ModQuadricT<Mesh>(mesh) { mesh.add_property(corners_); }
    ~SeamQuadric() override { mesh().remove_property(corners_); }

    void limitError(double distance) { squaredLimit_ = distance * distance; }
    FaceCorners& corners(OpenMesh::FaceHandle face) { return mesh().property(corners_, face); }

    float collapse_priority(const CollapseInfo& info) override {
        if (foldsFeature(info) || turnsFaceOver(info) || squaredDistanceToFaces(info) > squaredLimit_) {
            return static_cast<float>(ILLEGAL_COLLAPSE);
        }
        const float surface = ModQuadricT<Mesh>::collapse_priority(info);
        if (surface < 0.0f || !mesh().status(info.v0).feature()) return surface;
        return std::max(surface, static_cast<float>(lineError(info)));
    }

    void preprocess_collapse(const CollapseInfo& info) override {
        // Faces to the left of v0v1 take the vertex that the left face shows at v1, faces to the right the
        // right one's.
        const std::uint32_t leftFrom = sideVertex(info.fl, info.v0), leftTo = sideVertex(info.fl, info.v1);
        const std::uint32_t rightFrom = sideVertex(info.fr, info.v0), rightTo = sideVertex(info.fr, info.v1);
        for (auto face = mesh().vf_begin(info.v0); face != mesh().vf_end(info.v0); ++face) {
            for (FaceCorner& corner : corners(*face)) {
                if (corner.place != info.v0) continue;
                const bool left = info.fl.is_valid() && corner.vertex == leftFrom;
                if (!left && !(info.fr.is_valid() && corner.vertex == rightFrom)) continue;
                corner = {info.v1, left ? leftTo : rightTo};
            }
        }
    }

  private:
    [[nodiscard]] std::uint32_t sideVertex(OpenMesh::FaceHandle face, OpenMesh::VertexHandle place) {
        return face.is_valid() ? vertexAt(corners(face), place) : ~std::uint32_t{0};
    }

    // The line at v0 turns into an edge of a face that vanishes: that face's third edge would have to become
    // the line, and does not know it.
    bool foldsFeature(const CollapseInfo& info) {
        if (!mesh().status(info.v0).feature()) return false;
        for (const OpenMesh::VertexHandle third : {info.vl, info.vr}) {
            if (!third.is_valid()) continue;
            const OpenMesh::HalfedgeHandle edge = mesh().find_halfedge(info.v0, third);
            if (edge.is_valid() && mesh().status(mesh().edge_handle(edge)).feature()) return true;
        }
        return false;
    }

    bool turnsFaceOver(const CollapseInfo& info) {
        for (auto face = mesh().vf_begin(info.v0); face != mesh().vf_end(info.v0); ++face) {
            if (*face == info.fl || *face == info.fr) continue;
            std::array<OpenMesh::Vec3d, 3> before, after;
            std::size_t k = 0;
            for (auto v = mesh().fv_begin(*face); v != mesh().fv_end(*face); ++v, ++k) {
                before[k] = mesh().point(*v);
                after[k] = *v == info.v0 ? info.p1 : before[k];
            }
            const OpenMesh::Vec3d n = (before[1] - before[0]) % (before[2] - before[0]);
            const OpenMesh::Vec3d m = (after[1] - after[0]) % (after[2] - after[0]);
            if ((n | m) <= 0.1 * n.norm() * m.norm()) return true;
        }
        return false;
    }

    // Squared distance of v0 from the line that replaces the two pieces of seam at v0, weighted like the
    // quadrics by an area.
    double lineError(const CollapseInfo& info) {
        for (auto h = mesh().voh_begin(info.v0); h != mesh().voh_end(info.v0); ++h) {
            const OpenMesh::VertexHandle other = mesh().to_vertex_handle(*h);
            if (other == info.v1 || !mesh().status(mesh().edge_handle(*h)).feature()) continue;
            const OpenMesh::Vec3d along = mesh().point(other) - info.p1, to = info.p0 - info.p1;
            const double length2 = along.sqrnorm();
            if (length2 == 0.0) return to.sqrnorm() * to.sqrnorm();
            return (to % along).sqrnorm();  // distance^2 * length^2
        }
        return 0.0;
    }

    // How far v0 lies from the nearest plane of the faces that remain around it: the local error of the
    // collapse.
    double squaredDistanceToFaces(const CollapseInfo& info) {
        double least = (info.p0 - info.p1).sqrnorm();
        for (auto face = mesh().vf_begin(info.v0); face != mesh().vf_end(info.v0); ++face) {
            if (*face == info.fl || *face == info.fr) continue;
            std::array<OpenMesh::Vec3d, 3> p;
            std::size_t k = 0;
            for (auto v = mesh().fv_begin(*face); v != mesh().fv_end(*face); ++v, ++k) {
                p[k] = *v == info.v0 ? info.p1 : mesh().point(*v);
            }
            const OpenMesh::Vec3d n = (p[1] - p[0]) % (p[2] - p[0]);
            if (n.sqrnorm() == 0.0) continue;
            const double height = n | (info.p0 - p[0]);
            least = std::min(least, height * height / n.sqrnorm());
        }
        return least;
    }

    OpenMesh::FPropHandleT<FaceCorners> corners_;
    double squaredLimit_ = std::numeric_limits<double>::infinity();
};

// The half-edge mesh of the input: vertices are places. A face that would be non-manifold gets corners of its
// own, locked with the places they lie on, so that it opens no gap.
class MeshMaker {
  public:
    MeshMaker(const SimplifyInput& input, Mesh& mesh) : input_(input), mesh_(mesh) {}

    // By face handle: the input vertices of its corners.
    std::vector<FaceCorners> addAll(std::uint64_t& carried) {
        std::uint32_t places = 0;
        for (const std::uint32_t place : input_.places) places = std::max(places, place + 1);
        handles_.resize(places);
        std::vector<FaceCorners> corners;
        for (const glm::uvec3& triangle : input_.triangles) {
            FaceCorners face;
            for (int k = 0; k < 3; ++k)
                face[static_cast<std::size_t>(k)] = {handleOf(triangle[k]), triangle[k]};
            OpenMesh::FaceHandle added;
            if (canAdd(face)) added = mesh_.add_face(face[0].place, face[1].place, face[2].place);
            if (!added.is_valid()) {
                ++carried;
                for (FaceCorner& corner : face) {
                    mesh_.status(corner.place).set_locked(true);
                    // A copy: the mesh's own point moves while the vertex is added.
                    const OpenMesh::Vec3d point = mesh_.point(corner.place);
                    corner.place = mesh_.add_vertex(point);
                    mesh_.status(corner.place).set_locked(true);
                }
                mesh_.add_face(face[0].place, face[1].place, face[2].place);
            }
            corners.push_back(face);
        }
        return corners;
    }

  private:
    OpenMesh::VertexHandle handleOf(std::uint32_t vertex) {
        OpenMesh::VertexHandle& handle = handles_[input_.places[vertex]];
        if (!handle.is_valid()) {
            const glm::dvec3 p(input_.points[vertex]);
            handle = mesh_.add_vertex(OpenMesh::Vec3d(p.x, p.y, p.z));
        }
        if (input_.locked[vertex] != 0) mesh_.status(handle).set_locked(true);
        return handle;
    }

    [[nodiscard]] bool canAdd(const FaceCorners& face) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const OpenMesh::VertexHandle a = face[k].place, b = face[(k + 1) % 3].place;
            if (a == b || !mesh_.is_boundary(a)) return false;
            const OpenMesh::HalfedgeHandle edge = mesh_.find_halfedge(a, b);
            if (edge.is_valid() && !mesh_.is_boundary(edge)) return false;
        }
        return true;
    }

    const SimplifyInput& input_;
    Mesh& mesh_;
    std::vector<OpenMesh::VertexHandle> handles_;
};

// Borders and edges whose sides show different vertices are features: their vertices move along them only,
// and ends and crossings of features not at all.
void markFeatures(Mesh& mesh, SeamQuadric& module) {
    for (const auto edge : mesh.edges()) {
        bool feature = mesh.is_boundary(edge);
        if (!feature) {
            const OpenMesh::HalfedgeHandle h = mesh.halfedge_handle(edge, 0);
            const FaceCorners& left = module.corners(mesh.face_handle(h));
            const FaceCorners& right = module.corners(mesh.opposite_face_handle(h));
            for (const auto place : {mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)}) {
                feature = feature || vertexAt(left, place) != vertexAt(right, place);
            }
        }
        if (feature) mesh.status(edge).set_feature(true);
    }
    for (const auto vertex : mesh.vertices()) {
        int features = 0;
        for (const auto edge : mesh.ve_range(vertex)) features += mesh.status(edge).feature() ? 1 : 0;
        if (features > 0) mesh.status(vertex).set_feature(true);
        if (features > 0 && features != 2) mesh.status(vertex).set_locked(true);
    }
}

}  // namespace

SimplifyOutput simplifyWithOpenMesh(const SimplifyInput& input) {
    // What it would print about non-manifold faces is counted instead.
    [[maybe_unused]] static const bool quiet = (omerr().disable(), true);
    SimplifyOutput output;
    Mesh mesh;
    const std::vector<FaceCorners> corners = MeshMaker(input, mesh).addAll(output.carriedTriangles);
    Decimater decimater(mesh);
    OpenMesh::Decimater::ModHandleT<SeamQuadric> handle;
    decimater.add(handle);
    SeamQuadric& module = decimater.module(handle);
    for (const auto face : mesh.faces()) module.corners(face) = corners[static_cast<std::size_t>(face.idx())];
    markFeatures(mesh, module);
    Box3f bounds;
    for (const glm::vec3& point : input.points) bounds.grow(point);
    const glm::vec3 size = bounds.size();
    module.limitError(kErrorLimit * static_cast<double>(std::max(size.x, std::max(size.y, size.z))));
    if (decimater.initialize()) decimater.decimate_to_faces(0, input.targetTriangles);
    for (const auto face : mesh.faces()) {  // skips deleted ones
        glm::uvec3 triangle(0);
        int k = 0;
        for (auto v = mesh.fv_begin(face); v != mesh.fv_end(face); ++v, ++k) {
            triangle[k] = vertexAt(module.corners(face), *v);
            FB_CHECK(triangle[k] < input.points.size());
        }
        output.triangles.push_back(triangle);
    }
    return output;
}

}  // namespace fb
