% SPDX-License-Identifier: GPL-3.0-or-later
% Reads results of flankfilm in MATLAB or GNU Octave (there with the package netcdf).
%
%   flankfilm run configs/octave/torque.yaml -o results/torque
%   flankfilm export results/torque --to netcdf        # results/torque/results.nc
%   octave configs/octave/example.m results/torque/results.nc
%
% Values are in SI. MATLAB and Octave reverse the order of dimensions in the file:
% film.h_min(torque, film.t) becomes an array of t x torque.

if exist('OCTAVE_VERSION', 'builtin')
  pkg load netcdf
  words = argv();
else
  words = {};
end
file = 'results/torque/results.nc';
if ~isempty(words)
  file = words{end};
end

torque = ncread(file, 'torque');                       % the varied parameter
film = ncread(file, 'film.h_min');                     % t x torque
unit = ncreadatt(file, 'film.h_min', 'units');
what = ncreadatt(file, 'film.h_min', 'long_name');
lowest = ncread(file, 'film.h_min_lowest');            % a scalar of each case
good = ncread(file, 'status') == 0;                    % failed cases are NaN

fprintf('%s [%s]\n', what, unit);
for k = 1:numel(torque)
  if good(k)
    fprintf('%g N m: %.4g %s, %d points, least %.4g %s\n', torque(k), lowest(k), unit, ...
            sum(~isnan(film(:, k))), min(film(:, k)), unit);
  end
end
line = polyfit(log(torque(good)), log(lowest(good)), 1);
fprintf('the least film varies with the torque to the power of %.3f\n', line(1));

if ~isempty(getenv('DISPLAY')) || usejava('desktop')
  plot(film * 1e6);
  xlabel('time step');
  ylabel([what ' [um]']);
  legend(arrayfun(@(t) sprintf('%g N m', t), torque, 'UniformOutput', false));
end
