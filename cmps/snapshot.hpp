/// What a near field must remember to go on bit for bit: particles in their order, the lists' reference
/// places, what decides the next step, the effects' own state.
#pragma once

#include "cmps/near_field.hpp"
#include "common/data_file.hpp"

namespace cmps {

void save(const NearField& field, common::DataFile& state);

/// `field` is built from the same scene. Throws InputError when a dataset is absent.
void restore(NearField& field, const common::DataFile& state);

}  // namespace cmps
