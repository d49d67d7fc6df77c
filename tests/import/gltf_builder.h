// Small glTF documents for tests: numbers go into one buffer, each array as an accessor with a view of its
// own.
#pragma once

#include "temp_folder.h"

namespace fb::test {

inline std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned value = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            value = value << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : kDigits[value >> (18 - 6 * k) & 63];
    }
    return text;
}

class GltfBuilder {
  public:
    enum Component {
        kByte = 5120,
        kUByte = 5121,
        kShort = 5122,
        kUShort = 5123,
        kUInt = 5125,
        kFloat = 5126
    };

    // Returns the number of the accessor. `more` goes into its JSON, such as ,"normalized":true.
    template <class T>
    int add(const std::vector<T>& numbers, int component, const std::string& type,
            const std::string& more = "") {
        const std::size_t perElement = type == "SCALAR" ? 1 : static_cast<std::size_t>(type[3] - '0');
        const int view = addView(bytesOf(numbers));
        accessors_ += (accessors_.empty() ? "" : ",") + std::string("{\"bufferView\":") +
                      std::to_string(view) + ",\"componentType\":" + std::to_string(component) +
                      ",\"type\":\"" + type + "\",\"count\":" + std::to_string(numbers.size() / perElement) +
                      more + "}";
        return accessorCount_++;
    }

    int addView(const std::string& bytes) {
        views_ += (views_.empty() ? "" : ",") + std::string("{\"buffer\":0,\"byteOffset\":") +
                  std::to_string(buffer_.size()) + ",\"byteLength\":" + std::to_string(bytes.size()) + "}";
        buffer_ += bytes;
        buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');
        return viewCount_++;
    }

    template <class T>
    static std::string bytesOf(const std::vector<T>& numbers) {
        Bytes bytes;
        for (const T n : numbers) bytes.add(n);
        return bytes.text();
    }

    // `rest`: the members of the document behind asset, buffers, views and accessors.
    [[nodiscard]] std::string json(const std::string& rest, const std::string& uri) const {
        return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(buffer_.size()) +
               (uri.empty() ? "" : ",\"uri\":\"" + uri + "\"") + "}],\"bufferViews\":[" + views_ +
               "],\"accessors\":[" + accessors_ + "]," + rest + "}";
    }
    [[nodiscard]] std::string embedded(const std::string& rest) const {
        return json(rest, "data:application/octet-stream;base64," + base64(buffer_));
    }
    [[nodiscard]] std::string glb(const std::string& rest) const {
        std::string text = json(rest, "");
        text.resize((text.size() + 3) / 4 * 4, ' ');
        Bytes bytes;
        bytes.add("glTF").add(2u).add(static_cast<unsigned>(28 + text.size() + buffer_.size()));
        bytes.add(static_cast<unsigned>(text.size())).add("JSON").add(text);
        bytes.add(static_cast<unsigned>(buffer_.size())).add(std::string_view("BIN\0", 4)).add(buffer_);
        return bytes.text();
    }
    [[nodiscard]] const std::string& buffer() const { return buffer_; }

  private:
    std::string buffer_, views_, accessors_;
    int viewCount_ = 0, accessorCount_ = 0;
};

inline std::vector<float> cubePositions() {
    std::vector<float> numbers;
    for (const auto& c : kCubeCorners) {
        for (const double n : c) numbers.push_back(static_cast<float>(n));
    }
    return numbers;
}

template <class T>
std::vector<T> cubeIndices() {
    std::vector<T> numbers;
    for (const auto& t : kCubeTriangles) {
        for (const unsigned v : t) numbers.push_back(static_cast<T>(v));
    }
    return numbers;
}

// One mesh under one node.
inline std::string oneMesh(const std::string& primitive, const std::string& node = "") {
    return R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + node +
           R"(}],"meshes":[{"primitives":[)" + primitive + "]}]";
}

}  // namespace fb::test
