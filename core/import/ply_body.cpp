#include "import/ply_body.h"

namespace fb {

PlyBody::PlyBody(const MeshBytes& input, const PlyHeader& header)
    : input_(input),
      isAscii_(header.format == PlyFormat::ascii),
      isBigEndian_(header.format == PlyFormat::bigEndian),
      offset_(header.bodyOffset),
      words_(input.text().substr(header.bodyOffset)),
      headerLines_(header.lines) {}

std::size_t PlyBody::bytesLeft() const {
    return isAscii_ ? words_.bytesLeft() : input_.bytes.size() - offset_;
}

bool PlyBody::hasMore() {
    return isAscii_ ? !words_.next().empty() : bytesLeft() > 0;
}

std::string PlyBody::place() const {
    if (isAscii_) return "line " + std::to_string(headerLines_ + words_.line());
    return "byte " + std::to_string(offset_);
}

Result<void> PlyBody::checkCount(const PlyElement& element) const {
    std::uint64_t rowBytes = 0;
    for (const PlyProperty& p : element.properties) rowBytes += leastBytes(p.isList ? p.countType : p.type);
    if (rowBytes == 0) return {};  // rows without anything in them
    // The last number of an ascii file needs no line end.
    const std::uint64_t most = (bytesLeft() + (isAscii_ ? 1 : 0)) / rowBytes;
    if (element.count <= most) return {};
    return input_.failure(place(),
                          "the header promises " + std::to_string(element.count) + " rows of " +
                              inQuotes(element.name) + ", the rest of the file can hold " +
                              std::to_string(most),
                          "the file is cut off or damaged");
}

Result<void> PlyBody::readRow(const PlyElement& element, PlyRow& row) {
    row.scalars.resize(element.properties.size());
    row.lists.resize(element.properties.size());
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (!property.isList) {
            if (!next(property.type, row.scalars[i])) return wrong(element, property);
            continue;
        }
        double count = 0.0;
        if (!next(property.countType, count) || !(count >= 0.0)) return wrong(element, property);
        const std::uint64_t most = (bytesLeft() + (isAscii_ ? 1 : 0)) / leastBytes(property.type);
        if (!(count <= static_cast<double>(most))) return wrong(element, property);
        row.lists[i].resize(static_cast<std::size_t>(count));
        for (double& value : row.lists[i]) {
            if (!next(property.type, value)) return wrong(element, property);
        }
    }
    return {};
}

bool PlyBody::next(PlyType type, double& value) {
    if (isAscii_) return toReal(words_.next(), value);
    const std::size_t size = sizeOf(type);
    if (input_.bytes.size() - offset_ < size) return false;
    const std::uint8_t* const at = input_.bytes.data() + offset_;
    offset_ += size;
    switch (type) {
        case PlyType::int8:
            value = static_cast<std::int8_t>(*at);
            break;
        case PlyType::uint8:
            value = *at;
            break;
        case PlyType::int16:
            value = loadNumber<std::int16_t>(at, isBigEndian_);
            break;
        case PlyType::uint16:
            value = loadNumber<std::uint16_t>(at, isBigEndian_);
            break;
        case PlyType::int32:
            value = loadNumber<std::int32_t>(at, isBigEndian_);
            break;
        case PlyType::uint32:
            value = loadNumber<std::uint32_t>(at, isBigEndian_);
            break;
        case PlyType::float32:
            value = static_cast<double>(loadNumber<float>(at, isBigEndian_));
            break;
        case PlyType::float64:
            value = loadNumber<double>(at, isBigEndian_);
            break;
    }
    return true;
}

tl::unexpected<Error> PlyBody::wrong(const PlyElement& element, const PlyProperty& property) const {
    const std::string what = inQuotes(property.name) + " of " + inQuotes(element.name);
    if (bytesLeft() == 0)
        return input_.failure(place(), "the file ends inside " + what, "the file is cut off");
    return input_.failure(place(), what + " is not a number, or a list longer than the file",
                          "the file is damaged");
}

}  // namespace fb
