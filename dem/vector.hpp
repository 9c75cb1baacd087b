/// The vector types of this stage.
#pragma once

#include <Eigen/Dense>

namespace dem {

using Vector = Eigen::Vector3d;
using Rotation = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

}  // namespace dem
