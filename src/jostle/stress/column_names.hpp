#pragma once

#include <array>

// Names of the columns in which files hold tensors.

namespace jostle {

/// Names of the nine stress columns, by rows of the tensor.
inline constexpr std::array<const char*, 9> stress_column_names = {"stress_xx", "stress_xy", "stress_xz",
                                                                   "stress_yx", "stress_yy", "stress_yz",
                                                                   "stress_zx", "stress_zy", "stress_zz"};
/// Names of the six columns of the orientation stress, which is symmetric: xx xy xz yy yz zz.
inline constexpr std::array<const char*, 6> orientation_stress_column_names = {
    "stress_orientation_xx", "stress_orientation_xy", "stress_orientation_xz",
    "stress_orientation_yy", "stress_orientation_yz", "stress_orientation_zz"};
/// Nine of the active stress, where rods swim.
inline constexpr std::array<const char*, 9> active_stress_column_names = {
    "stress_active_xx", "stress_active_xy", "stress_active_xz", "stress_active_yx", "stress_active_yy",
    "stress_active_yz", "stress_active_zx", "stress_active_zy", "stress_active_zz"};
/// Six of the stresslets of swimmers and of thermal turning, where swimmers stir the fluid: xx xy xz yy yz zz.
inline constexpr std::array<const char*, 6> dipole_stress_column_names = {"stress_dipoles_xx", "stress_dipoles_xy",
                                                                          "stress_dipoles_xz", "stress_dipoles_yy",
                                                                          "stress_dipoles_yz", "stress_dipoles_zz"};
inline constexpr std::array<const char*, 6> thermal_stress_column_names = {"stress_thermal_xx", "stress_thermal_xy",
                                                                           "stress_thermal_xz", "stress_thermal_yy",
                                                                           "stress_thermal_yz", "stress_thermal_zz"};
/// Nine of springs, where there are some.
inline constexpr std::array<const char*, 9> spring_stress_column_names = {
    "stress_springs_xx", "stress_springs_xy", "stress_springs_xz", "stress_springs_yx", "stress_springs_yy",
    "stress_springs_yz", "stress_springs_zx", "stress_springs_zy", "stress_springs_zz"};
/// The same of aligning torques, where there are some.
inline constexpr std::array<const char*, 9> torque_stress_column_names = {
    "stress_torques_xx", "stress_torques_xy", "stress_torques_xz", "stress_torques_yx", "stress_torques_yy",
    "stress_torques_yz", "stress_torques_zx", "stress_torques_zy", "stress_torques_zz"};
/// Of the box, where a bath of pressure changes it.
inline constexpr std::array<const char*, 3> edge_column_names = {"edge_x", "edge_y", "edge_z"};
/// Of the contact forces on all fixed rods.
inline constexpr std::array<const char*, 3> fixed_rod_force_column_names = {"fixed_rod_force_x", "fixed_rod_force_y",
                                                                            "fixed_rod_force_z"};
/// Of a constant force between walls.
inline constexpr std::array<const char*, 3> force_moment_column_names = {"force_moment_x", "force_moment_y",
                                                                         "force_moment_z"};
/// The same of two other conventions, with `output.stress_conventions`.
inline constexpr std::array<const char*, 9> centre_of_mass_column_names = {
    "centre_of_mass_xx", "centre_of_mass_xy", "centre_of_mass_xz", "centre_of_mass_yx", "centre_of_mass_yy",
    "centre_of_mass_yz", "centre_of_mass_zx", "centre_of_mass_zy", "centre_of_mass_zz"};
inline constexpr std::array<const char*, 9> centre_line_column_names = {
    "centre_line_xx", "centre_line_xy", "centre_line_xz", "centre_line_yx", "centre_line_yy",
    "centre_line_yz", "centre_line_zx", "centre_line_zy", "centre_line_zz"};
/// Names of the six independent columns of the order tensor, xx xy xz yy yz zz.
inline constexpr std::array<const char*, 6> order_tensor_column_names = {"order_xx", "order_xy", "order_xz",
                                                                         "order_yy", "order_yz", "order_zz"};

}  // namespace jostle
