% Point film by EHL-FBNS: writes its input, runs its main script, prints what it found.
% Settings are those of its study A with steady smooth surfaces and its second order scheme.
warning('off', 'all');
confirm_recursive_rmdir(false);
given = jsondecode(getenv('FILM'));
n = given.nodes;
alg.Sim_ID = 'film';
fld = struct('h_min', 1e-9, 'p_amb', 0, 'p_cav', 0, 'flag_p_bound', 0, 'flag_thet_bound', 2);
for side = 'SWEN'
  fld.(['p_' side '_side']) = 0;
  fld.(['thet_' side '_side']) = 0;
end
fld.rho_0 = 850; fld.rho_flag = 1;
fld.dow_C1 = given.density_pressure; fld.dow_C2 = given.density_factor;
fld.mu_0 = given.eta0; fld.mu_flag = 2; fld.roe_alpha = given.alpha;
fld.roe_p0 = given.roelands_pressure; fld.roe_z = given.roelands_z;
fld.shear_thinning_model_flag = 0;
sld.flag_elastic = true; sld.E_dash = given.reduced_modulus;
u = given.speed;
opc = struct('flag_imposed', 2, 'F_N', given.load, 'u_m', u, 'srr', 0, 'u_r', 0, 'u_up', u, ...
             'u_low', u, 'N', 1, 'N_t', 1);
a = given.hertz_radius; R = given.radius;
geo.a = a; geo.Nx1 = n; geo.Nx2 = n; geo.N = n*n; geo.Rx1 = R;
geo.x1 = linspace(-given.half_width*a, given.half_width*a, n); geo.x2 = geo.x1;
geo.dx1 = geo.x1(2) - geo.x1(1); geo.dx2 = geo.dx1;
[x, y] = ndgrid(geo.x1, geo.x2);
geo.h_g_ma = (x.^2 + y.^2)/(2*R); geo.x3 = -geo.h_g_ma;
alg.flag_unsteady = false; alg.it_tot_max = 1e4;
alg.FBNS = struct('toll', 1e-6, 'alpha_p_nd', 5e-2, 'alpha_thet', 5e-2, ...
  'flag_enforce_limit_p_nd_red_min', true, 'flag_enforce_limit_thet_red_min', true, ...
  'flag_enforce_limit_p_red_max', false, 'flag_enforce_limit_thet_red_max', true, ...
  'flag_res', 6, 'flag_print_it', 0, 'flag_Couette_Discrete', 2, 'flag_A_h_S', true, ...
  'flag_A_h_WW', false, 'flag_A_h_E', true, 'flag_A_h_N', true, 'flag_p_hd_ini', 1);
alg.FBNS.ref = struct('x1', a, 'x2', a, 'h', a^2/R, 'mu', fld.mu_0, 'rho', fld.rho_0, 'u', u, ...
                      'p', given.hertz_pressure);
alg.load = struct('toll', 1e-6, 'h_d_ma_ini', -1e-6, 'K_P', 1e-3, 'K_I', 2e-2, 'K_D', 1e-3);
alg.load.ref.F_N = given.load;
alg.flag_profile_viewer = false; alg.flag_limit_num_comp_threads = false;
folder = './../data/EHL_02_mainprocess/Input/';
mkdir(folder);
for name = {'fld', 'sld', 'geo', 'opc', 'alg'}
  save('-mat', [folder name{1} '.mat'], name{1});
end
main_process;
centre = (n + 1)/2;
answer = struct('seconds', alg.FBNS.eval_time.tot, 'central', h.h_m(centre, centre), ...
                'minimum', sol.h_m_min, 'iterations', alg.it_tot);
if alg.it_tot >= alg.it_tot_max
  answer = struct('error', 'iteration limit');
end
printf('\nANSWER %s\n', jsonencode(answer));
