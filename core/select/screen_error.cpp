#include "select/screen_error.h"

#include <algorithm>
#include <cmath>

#include "select/surface_distance.h"

namespace fb {
namespace {

struct Picture {
    double pixels, diagonalPixels;
    double inverseCosSquared;  // 1/cos^2 phi = 1 + tan^2 phi, tan phi = half the diagonal / K
};

Picture pictureOf(const View& view) {
    const double w = view.width, h = view.height, squared = w * w + h * h;
    return {w * h, std::sqrt(squared), 1.0 + squared / (4.0 * view.pixelsPerUnit * view.pixelsPerUnit)};
}

double errorPixels(double errorMetres, double distanceMetres, double pixelsPerUnit, const Picture& picture) {
    if (!(errorMetres > 0.0)) return 0.0;
    if (distanceMetres <= errorMetres) return picture.diagonalPixels;
    return std::min(picture.diagonalPixels,
                    errorMetres * pixelsPerUnit / (distanceMetres - errorMetres) * picture.inverseCosSquared);
}

}  // namespace

double nodeErrorPixels(const Hierarchy& hierarchy, NodeId node, const View& view) {
    return errorPixels(static_cast<double>(hierarchy.geometricErrorMetres[node]),
                       surfaceDistance(hierarchy, node, view.camera.eye), view.pixelsPerUnit, pictureOf(view));
}

double coveredPixels(const Hierarchy& hierarchy, NodeId node, const View& view) {
    const double scale = view.pixelsPerUnit / surfaceDistance(hierarchy, node, view.camera.eye);  // may be infinite
    const double area = static_cast<double>(hierarchy.areaSquareMetres[node]);
    return area > 0.0 ? std::min(1.0 * view.width * view.height, area * scale * scale) : 0.0;
}

FrontError frontError(const Hierarchy& hierarchy, std::span<const NodeId> front, const View& view) {
    const Picture picture = pictureOf(view);
    FrontError error;
    double sum = 0.0, weights = 0.0;
    for (NodeId node : front) {
        const double distance = surfaceDistance(hierarchy, node, view.camera.eye);
        const double pixels = errorPixels(static_cast<double>(hierarchy.geometricErrorMetres[node]), distance,
                                          view.pixelsPerUnit, picture);
        const double weight = coveredPixels(hierarchy, node, view);
        error.maxPixels = std::max(error.maxPixels, pixels);
        sum += weight * pixels;
        weights += weight;
    }
    if (weights > 0.0) error.meanPixels = sum / weights;
    return error;
}

}  // namespace fb
