/// [wires]: constants and links, from the scene or from a layout file.
#include <fmt/format.h>

#include <set>

#include "dem/scene.hpp"

namespace dem {

using common::Range;
using common::SceneFile;
using common::Section;

namespace {

/// Reads the links of one [wires] section into `scene.wires`; mistakes are noted where they stand.
class LinkReader {
 public:
    LinkReader(const SceneFile& file, Scene& scene) : file_(file), scene_(scene) {}

    void single(const Section& entry) {
        const auto numbers =
            entry.numbers("blocks", "-", "numbers of the two blocks, from 1", 2, Range::any());
        LinkRequest link = options(entry);
        // All keys are read before any is judged: a mistake in one does not make others unknown.
        std::vector<double> spheres;
        if (entry.has("spheres"))
            spheres = entry.numbers("spheres", "-", "numbers of the two spheres, from 1", 2, Range::any());
        if (!block(entry, "blocks", numbers[0], link.block_a) ||
            !block(entry, "blocks", numbers[1], link.block_b))
            return;
        if (link.block_a == link.block_b) {
            entry.problem("blocks", fmt::format("block {} is linked to itself", link.block_a + 1));
            return;
        }
        if (scene_.placed.is_fixed[link.block_a] && scene_.placed.is_fixed[link.block_b]) {
            entry.problem("blocks",
                          fmt::format("blocks {} and {} are both fixed: a wire between them does nothing",
                                      link.block_a + 1, link.block_b + 1));
            return;
        }
        if (!spheres.empty()) {
            std::array<std::uint32_t, 2> chosen{};
            if (!sphere(entry, spheres[0], link.block_a, chosen[0]) ||
                !sphere(entry, spheres[1], link.block_b, chosen[1]))
                return;
            link.spheres = chosen;
            if (entry.has("wires")) {
                entry.problem("wires", "does not go with spheres, which name the one wire");
                return;
            }
        }
        add(entry, "blocks", link);
    }

    /// Neighbours in the same row.
    void along(const Section& entry) {
        if (!has_grid(entry)) return;
        const auto rows = numbers(entry, "rows", "rows whose neighbours are linked, from 1", scene_.rows);
        const auto columns = span(entry, "columns", "first and last column, from 1", scene_.columns);
        const LinkRequest options_of_all = options(entry);
        for (const auto row : rows)
            for (std::size_t column = columns[0]; column < columns[1]; ++column)
                add_grid(entry, "rows", options_of_all, row, column, row, column + 1);
    }

    /// Neighbours in the same column.
    void across(const Section& entry) {
        if (!has_grid(entry)) return;
        const auto columns =
            numbers(entry, "columns", "columns whose neighbours are linked, from 1", scene_.columns);
        const auto rows = span(entry, "rows", "first and last row, from 1", scene_.rows);
        const LinkRequest options_of_all = options(entry);
        for (const auto column : columns)
            for (std::size_t row = rows[0]; row < rows[1]; ++row)
                add_grid(entry, "columns", options_of_all, row, column, row + 1, column);
    }

    void put_back(const Section& wires) {
        if (!wires.has("put_back")) return;
        const Section section = wires.table("put_back");
        std::set<std::uint32_t> chosen;
        if (section.has("rows") && has_grid(section))
            for (const auto row : numbers(section, "rows", "rows put back to their packed pose", scene_.rows))
                for (std::size_t column = 1; column <= scene_.columns; ++column)
                    chosen.insert(at(row, column));
        if (section.has("blocks"))
            for (const double number :
                 section.numbers("blocks", "-", "blocks put back to their packed pose", 0, Range::any()))
                if (std::uint32_t found = 0; block(section, "blocks", number, found)) {
                    if (scene_.placed.is_fixed[found] != 0)
                        section.problem(
                            "blocks", fmt::format("block {} is fixed: it is where it was packed", found + 1));
                    chosen.insert(found);
                }
        scene_.wires.put_back.assign(chosen.begin(), chosen.end());
    }

 private:
    /// Rows and columns are those of [dem.blocks].
    bool has_grid(const Section& entry) const {
        if (scene_.rows > 0) return true;
        if (!file_.has_problems())
            entry.problem("", "needs [dem.blocks], whose rows and columns it speaks of");
        entry.keys();  // known, but not judged
        return false;
    }
    static LinkRequest options(const Section& entry) {
        LinkRequest link{};
        link.wires = static_cast<std::size_t>(entry.integer(
            "wires", "of the pairs of facing spheres, evenly chosen; 0: all", Range::not_negative(), 0));
        if (entry.has("rest_length"))
            link.rest_length =
                entry.number("rest_length", "m", "r0; default: distance of centres when packed",
                             Range::not_negative(), 0.0);
        if (entry.has("rest_length") && entry.has("slack"))
            entry.problem("slack", "does not go with rest_length: it is added to the packed distance");
        link.slack = entry.number("slack", "m", "added to the packed distance", Range::not_negative(), 0.0);
        if (entry.has("stiffness"))
            link.stiffness =
                entry.number("stiffness", "N/m", "of one wire; default k_n", Range::positive(), 1.0);
        return link;
    }
    bool block(const Section& entry, const char* key, double number, std::uint32_t& found) const {
        const auto count = scene_.placed.size();
        if (number < 1 || number > static_cast<double>(count) || number != std::floor(number)) {
            if (count > 0 || !file_.has_problems())
                entry.problem(key, fmt::format("no block {}; blocks are numbered 1 to {}", number, count));
            return false;
        }
        found = static_cast<std::uint32_t>(number) - 1;
        return true;
    }
    bool sphere(const Section& entry, double number, std::uint32_t of, std::uint32_t& found) const {
        const auto& shape = scene_.placed.shape_of(of);
        if (number < 1 || number > static_cast<double>(shape.spheres.size()) ||
            number != std::floor(number)) {
            entry.problem("spheres",
                          fmt::format("no sphere {} in shape '{}'; its spheres are numbered 1 to {}", number,
                                      shape.name, shape.spheres.size()));
            return false;
        }
        found = static_cast<std::uint32_t>(number) - 1;
        return true;
    }
    std::vector<std::size_t> numbers(const Section& entry, const char* key, const char* about,
                                     std::size_t highest) const {
        std::vector<std::size_t> result;
        const auto given = entry.numbers(key, "-", about, 0, Range::any());
        if (given.empty() && entry.has(key)) entry.problem(key, "names none");
        for (const double number : given) {
            if (number < 1 || number > static_cast<double>(highest) || number != std::floor(number))
                entry.problem(key, fmt::format("no number {}; expected 1 to {}", number, highest));
            else
                result.push_back(static_cast<std::size_t>(number));
        }
        return result;
    }
    std::array<std::size_t, 2> span(const Section& entry, const char* key, const char* about,
                                    std::size_t highest) const {
        const auto ends = entry.numbers(key, "-", about, 2, Range::any(),
                                        std::vector<double>{1, static_cast<double>(highest)});
        const bool is_whole = ends[0] == std::floor(ends[0]) && ends[1] == std::floor(ends[1]);
        if (!(is_whole && ends[0] >= 1 && ends[1] > ends[0] && ends[1] <= static_cast<double>(highest))) {
            entry.problem(
                key,
                highest > 1
                    ? fmt::format("expected first and last of the neighbours, whole numbers within 1 to {}",
                                  highest)
                    : fmt::format("there is but one: no neighbours to link"));
            return {1, 1};
        }
        return {static_cast<std::size_t>(ends[0]), static_cast<std::size_t>(ends[1])};
    }
    std::uint32_t at(std::size_t row, std::size_t column) const {
        return static_cast<std::uint32_t>((row - 1) * scene_.columns + column - 1);
    }
    void add_grid(const Section& entry, const char* key, LinkRequest link, std::size_t row_a,
                  std::size_t column_a, std::size_t row_b, std::size_t column_b) {
        link.block_a = at(row_a, column_a);
        link.block_b = at(row_b, column_b);
        add(entry, key, link);
    }
    void add(const Section& entry, const char* key, const LinkRequest& link) {
        const auto places = wires_of(scene_.placed, link, scene_.surroundings.period);
        if (link.wires > places.size()) {
            entry.problem("wires", fmt::format("blocks {} and {} have {} pairs of facing spheres",
                                               link.block_a + 1, link.block_b + 1, places.size()));
            return;
        }
        for (auto place : places) {
            place = in_order(place);
            if (!taken_.insert(place).second) {
                entry.problem(key,
                              fmt::format("blocks {} and {} are linked twice at the same spheres ({} and {})",
                                          place.block_a + 1, place.block_b + 1, place.sphere_a + 1,
                                          place.sphere_b + 1));
                return;
            }
        }
        scene_.wires.links.push_back(link);
    }

    const SceneFile& file_;
    Scene& scene_;
    std::set<WirePlace> taken_;
};

}  // namespace

void read_wires(const SceneFile& file, const SceneFile* layout, Scene& scene) {
    const Section own = file.section("wires");
    const Section links = layout != nullptr ? layout->section("wires") : own;
    // Constants stand in the scene unless the layout has them, so that --set wires.psi works with any layout.
    const auto home = [&](const char* key) { return layout != nullptr && links.has(key) ? links : own; };
    scene.wires.psi =
        home("psi").number("psi", "d", "a wire breaks beyond r0 + psi d", Range::not_negative(), 0.3);
    scene.wires.law =
        home("law").choice("law", "reading of eq. (13)", {"hooke", "progressive"}, "hooke") == "hooke"
            ? WireLaw::hooke
            : WireLaw::progressive;
    scene.wires.stiffness =
        home("stiffness")
            .number("stiffness", "N/m", "k_n of a wire; default: Hertz stiffness at dem.reference_overlap",
                    Range::positive(),
                    scene.material.hertz_stiffness(scene.element.diameter / 4, scene.reference_overlap));
    if (layout != nullptr) own.keys();  // the scene's own links stand aside: known, but not read
    LinkReader reader(file, scene);
    for (const Section& entry : links.tables("link")) reader.single(entry);
    for (const Section& entry : links.tables("along")) reader.along(entry);
    for (const Section& entry : links.tables("across")) reader.across(entry);
    reader.put_back(links);
}

}  // namespace dem
