// Whether a text is well-formed XML of the kind that our SVG writer may use: one root, tags closed in order,
// attributes quoted, entities known, no stray signs. The fault in words, empty for none.
#pragma once

#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace fb::test {

inline std::string faultInText(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if (byte < 0x20 && byte != '\n') return "a control character";
        if (text[i] == '<' || text[i] == '>') return "a stray " + std::string(1, text[i]);
        if (text[i] != '&') continue;
        bool known = false;
        for (std::string_view entity : {"&amp;", "&lt;", "&gt;", "&quot;"})
            known |= text.substr(i).starts_with(entity);
        if (!known) return "an unknown entity";
    }
    return {};
}

// The inside of a tag after its name: name="value" any number of times.
inline std::string faultInAttributes(std::string_view rest) {
    while (!rest.empty()) {
        if (rest.front() != ' ') return "no space before an attribute";
        rest.remove_prefix(1);
        const std::size_t equals = rest.find("=\"");
        if (equals == std::string_view::npos || equals == 0) return "an attribute without a value";
        for (char c : rest.substr(0, equals)) {
            if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') return "a bad attribute name";
        }
        rest.remove_prefix(equals + 2);
        const std::size_t end = rest.find('"');
        if (end == std::string_view::npos) return "an open quote";
        if (std::string fault = faultInText(rest.substr(0, end)); !fault.empty()) return fault;
        rest.remove_prefix(end + 1);
    }
    return {};
}

inline std::string faultInXml(std::string_view xml) {
    if (xml.starts_with("<?xml ")) xml.remove_prefix(xml.find("?>") + 2);
    std::vector<std::string> open;
    bool rootSeen = false;
    while (!xml.empty()) {
        const std::size_t tag = xml.find('<');
        const std::string_view words = xml.substr(0, tag);
        if (std::string fault = faultInText(words); !fault.empty()) return fault;
        if (open.empty() && words.find_first_not_of("\n ") != std::string_view::npos)
            return "text outside the root";
        if (tag == std::string_view::npos) break;
        const std::size_t end = xml.find('>', tag);
        if (end == std::string_view::npos) return "an open tag";
        std::string_view inside = xml.substr(tag + 1, end - tag - 1);
        xml.remove_prefix(end + 1);
        if (inside.starts_with('/')) {
            if (open.empty() || open.back() != inside.substr(1)) return "a tag closed out of order";
            open.pop_back();
            continue;
        }
        const bool closed = inside.ends_with('/');
        if (closed) inside.remove_suffix(1);
        const std::string name(inside.substr(0, inside.find(' ')));
        if (open.empty() && rootSeen) return "a second root";
        rootSeen = true;
        if (std::string fault = faultInAttributes(inside.substr(name.size())); !fault.empty()) return fault;
        if (!closed) open.push_back(name);
    }
    if (!open.empty()) return "<" + open.back() + "> is not closed";
    return rootSeen ? "" : "no root";
}

}  // namespace fb::test
