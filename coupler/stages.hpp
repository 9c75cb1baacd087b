/// The stages of the chain in their order, and where each keeps its files.
#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace coupler {

struct StagePlace {
    std::string name;             ///< program and scene section
    std::string folder;           ///< inside the chain's folder
    std::string upstream_option;  ///< takes the folder of the stage before; empty for the first
};

inline const std::array<StagePlace, 3> chain_stages{
    {{"boussinesq", "waves", ""}, {"cmps", "flow", "--waves"}, {"dem", "blocks", "--flow"}}};

}  // namespace coupler
