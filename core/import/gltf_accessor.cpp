#include "import/gltf_accessor.h"

#include <algorithm>

#include "import/parse_bytes.h"

namespace fb {
namespace {

// `count` elements of `elementBytes` at distance `stride`, from `offset` in a view; null where that is not in
// it.
const std::uint8_t* bytesOfView(const tinygltf::Model& model, int view, std::uint64_t offset,
                                std::uint64_t count, std::uint64_t stride, std::uint64_t elementBytes) {
    if (view < 0 || static_cast<std::size_t>(view) >= model.bufferViews.size() || count == 0) return nullptr;
    const tinygltf::BufferView& v = model.bufferViews[static_cast<std::size_t>(view)];
    if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= model.buffers.size()) return nullptr;
    const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(v.buffer)].data;
    if (v.byteOffset > data.size() || v.byteLength > data.size() - v.byteOffset) return nullptr;
    if (offset > v.byteLength || elementBytes > v.byteLength - offset) return nullptr;
    if (count - 1 > (v.byteLength - offset - elementBytes) / stride) return nullptr;
    return data.data() + v.byteOffset + offset;
}

double rawNumber(const std::uint8_t* at, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return static_cast<std::int8_t>(*at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return *at;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return loadNumber<std::int16_t>(at, false);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return loadNumber<std::uint16_t>(at, false);
        case TINYGLTF_COMPONENT_TYPE_INT:
            return loadNumber<std::int32_t>(at, false);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return loadNumber<std::uint32_t>(at, false);
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return static_cast<double>(loadNumber<float>(at, false));
        default:
            return loadNumber<double>(at, false);
    }
}

// glTF 2.0, section 3.6.2.2.
double normalizedNumber(double value, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return std::max(value / 127.0, -1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return value / 255.0;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return std::max(value / 32767.0, -1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return value / 65535.0;
        default:
            return value;
    }
}

}  // namespace

Result<GltfAccessor> GltfAccessor::open(const MeshBytes& input, const tinygltf::Model& model, int accessor,
                                        int components) {
    const std::string place = "accessor " + std::to_string(accessor);
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size()) {
        return input.failure(place, "does not exist");
    }
    const tinygltf::Accessor& a = model.accessors[static_cast<std::size_t>(accessor)];
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(a.componentType));
    const int has = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type));
    if (size <= 0 || has < components) return input.failure(place, "has a type that does not fit its use");
    GltfAccessor opened;
    opened.count_ = a.count;
    opened.components_ = has;
    opened.componentBytes_ = static_cast<std::size_t>(size);
    opened.componentType_ = a.componentType;
    opened.normalized_ = a.normalized;
    const std::size_t elementBytes = opened.componentBytes_ * static_cast<std::size_t>(has);
    opened.stride_ = elementBytes;
    if (a.bufferView >= 0 && static_cast<std::size_t>(a.bufferView) < model.bufferViews.size()) {
        const std::size_t stride = model.bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride;
        if (stride != 0) opened.stride_ = stride;
    }
    opened.base_ = bytesOfView(model, a.bufferView, a.byteOffset, a.count, opened.stride_, elementBytes);
    if (opened.base_ == nullptr) {
        return input.failure(place, "does not lie within its buffer view", "the file is damaged");
    }
    if (!a.sparse.isSparse) return opened;

    const int indexType = a.sparse.indices.componentType;
    const int indexSize = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(indexType));
    if (a.sparse.count < 0 || a.sparse.indices.byteOffset < 0 || a.sparse.values.byteOffset < 0 ||
        indexSize <= 0) {
        return input.failure(place, "has sparse values that are not valid");
    }
    const auto count = static_cast<std::uint64_t>(a.sparse.count);
    const auto indexBytes = static_cast<std::uint64_t>(indexSize);
    const std::uint8_t* const indices =
        bytesOfView(model, a.sparse.indices.bufferView,
                    static_cast<std::uint64_t>(a.sparse.indices.byteOffset), count, indexBytes, indexBytes);
    const std::uint8_t* const values =
        bytesOfView(model, a.sparse.values.bufferView, static_cast<std::uint64_t>(a.sparse.values.byteOffset),
                    count, elementBytes, elementBytes);
    if (indices == nullptr || values == nullptr)
        return input.failure(place, "has sparse values outside its buffer");
    for (std::uint64_t i = 0; i < count; ++i) {
        const double index = rawNumber(indices + i * indexBytes, indexType);
        if (!(index >= 0.0 && index < static_cast<double>(a.count))) {
            return input.failure(place, "has a sparse value for an element that it does not have");
        }
        opened.replaced_[static_cast<std::uint32_t>(index)] = values + i * elementBytes;
    }
    return opened;
}

double GltfAccessor::number(std::size_t element, int component) const {
    const std::uint8_t* at = base_ + element * stride_;
    if (!replaced_.empty()) {
        const auto found = replaced_.find(static_cast<std::uint32_t>(element));
        if (found != replaced_.end()) at = found->second;
    }
    const double value =
        rawNumber(at + static_cast<std::size_t>(component) * componentBytes_, componentType_);
    return normalized_ ? normalizedNumber(value, componentType_) : value;
}

std::uint32_t GltfAccessor::index(std::size_t element) const {
    const double value = number(element, 0);
    // Out of range becomes an index that no mesh has.
    return value >= 0.0 && value < 4294967295.0 ? static_cast<std::uint32_t>(value) : ~std::uint32_t{0};
}

}  // namespace fb
