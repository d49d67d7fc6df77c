// Little-endian numbers of fixed width into and out of byte buffers. A reader never reads past its end: it
// gives zeros from there on and remembers it, so that a record is read first and asked once whether it was
// whole.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace fb {

static_assert(std::endian::native == std::endian::little, "vertices are coded as they lie in memory");

class ByteWriter {
  public:
    template <class T>
    requires std::integral<T> || std::floating_point<T> ByteWriter& put(T value) {
        return copy(&value, sizeof(T));
    }
    ByteWriter& put(const glm::vec3& v) { return put(v.x).put(v.y).put(v.z); }
    ByteWriter& put(const glm::dvec3& v) { return put(v.x).put(v.y).put(v.z); }
    ByteWriter& text(std::string_view text) { return copy(text.data(), text.size()); }
    ByteWriter& append(std::span<const std::uint8_t> bytes) { return copy(bytes.data(), bytes.size()); }
    void reserve(std::size_t sizeBytes) { bytes_.reserve(sizeBytes); }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }
    [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }
    [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    ByteWriter& copy(const void* from, std::size_t sizeBytes) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + sizeBytes);
        if (sizeBytes > 0) std::memcpy(bytes_.data() + at, from, sizeBytes);
        return *this;
    }

    std::vector<std::uint8_t> bytes_;
};

class ByteReader {
  public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : left_(bytes) {}

    template <class T>
    requires std::integral<T> || std::floating_point<T> T get() {
        T value{};
        const std::span<const std::uint8_t> raw = take(sizeof(T));
        if (!raw.empty()) std::memcpy(&value, raw.data(), sizeof(T));
        return value;
    }
    template <class T>
    void get(T& value) {
        value = get<T>();
    }
    void get(glm::vec3& v) {
        get(v.x);
        get(v.y);
        get(v.z);
    }
    void get(glm::dvec3& v) {
        get(v.x);
        get(v.y);
        get(v.z);
    }
    // The next bytes, or none when fewer are left.
    std::span<const std::uint8_t> take(std::size_t sizeBytes) {
        if (sizeBytes > left_.size()) {
            whole_ = false;
            left_ = {};
            return {};
        }
        const std::span<const std::uint8_t> taken = left_.first(sizeBytes);
        left_ = left_.subspan(sizeBytes);
        return taken;
    }
    bool isText(std::string_view expected) {
        const std::span<const std::uint8_t> raw = take(expected.size());
        return !raw.empty() && std::memcmp(raw.data(), expected.data(), expected.size()) == 0;
    }
    [[nodiscard]] std::size_t left() const { return left_.size(); }
    [[nodiscard]] bool whole() const { return whole_; }

  private:
    std::span<const std::uint8_t> left_;
    bool whole_ = true;
};

}  // namespace fb
